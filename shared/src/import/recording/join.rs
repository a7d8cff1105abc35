//! Rows that were recorded apart, put behind the rows before them.

use super::{MAX_DEMONSTRATIONS, Part, Recorder};

impl Recorder<'_> {
    /// Adds the rows of `next` as if they had been pushed one by one.
    ///
    /// Where they may not follow, or that cannot be told without looking at each of them, it returns `false` and nothing
    /// is added.
    ///
    /// # Complexity
    ///
    /// The values of at most one demonstration of `next` are copied; for each label there is one look-up.
    pub(in crate::import) fn join(&mut self, next: Self) -> bool {
        let Some(first) = next.parts.first() else { return true };
        let goes_on = self.parts.last().is_some_and(|last| last.label == first.label);
        let may_follow = self.parts.len() + next.parts.len() <= MAX_DEMONSTRATIONS
            && !next.parts[usize::from(goes_on)..].iter().any(|part| self.knows(part))
            && (!goes_on || self.times_go_on(&next));
        if may_follow {
            self.append(next, goes_on);
        }
        may_follow
    }

    fn append(&mut self, next: Self, goes_on: bool) {
        let is_one_part = next.parts.len() == 1;
        if self.columns.label.is_none() && self.parts.is_empty() {
            // With room for all that is expected.
            self.push_part(None);
        }
        let mut parts = next.parts.into_iter().peekable();
        if let Some(last) = self.parts.last_mut()
            && let Some(first) = parts.next_if(|first| first.label == last.label)
        {
            last.values.extend_from_slice(&first.values);
        }
        if parts.peek().is_some() {
            self.end_part();
            self.close_part();
        }
        self.parts.extend(parts);
        for (before, after) in self.before.iter_mut().zip(next.before) {
            let is_unknown = after.is_nan() && goes_on && is_one_part;
            *before = if is_unknown { *before } else { after };
        }
        self.ended.extend(next.ended);
        self.place = next.place;
    }

    /// Whether there were rows of a demonstration with the label of `part` already.
    fn knows(&self, part: &Part) -> bool {
        let is_last = self.parts.last().is_some_and(|last| last.label == part.label);
        is_last || part.label.as_ref().is_some_and(|label| self.ended.contains_key(label))
    }

    /// Whether the times of `next` go on where these are; where its first row has none, its others must not either.
    fn times_go_on(&self, next: &Self) -> bool {
        let has_times = |column: usize| next.parts.len() > 1 || !next.before[column].is_nan();
        self.before.iter().zip(&next.first).enumerate().all(|(column, (before, first))| {
            before.is_nan() || first >= before || (first.is_nan() && !has_times(column))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::column::{Columns, heading};

    type Line = (&'static str, f64, f64);

    fn columns(names: &[&str]) -> Columns {
        Columns::new(names.iter().map(|name| heading(name)).collect()).unwrap()
    }

    /// Lines of a label, a time and a value.
    fn recorded<'a>(columns: &'a Columns, lines: &[Line]) -> Recorder<'a> {
        let mut recorder = Recorder::new(columns);
        for (place, &(label, time, value)) in lines.iter().enumerate() {
            let row = recorder.blank_row();
            row.label.push_str(label);
            row.times[0] = time;
            row.values[0] = value;
            recorder.push_row(place).unwrap();
        }
        recorder
    }

    fn shown(recorder: Recorder) -> String {
        format!("{:?}", recorder.finish())
    }

    #[track_caller]
    fn check(names: &[&str], lines: &[Line]) {
        let columns = columns(names);
        let together = shown(recorded(&columns, lines));
        for middle in 0..=lines.len() {
            let mut first = recorded(&columns, &lines[..middle]);
            assert!(first.join(recorded(&columns, &lines[middle..])), "{middle}");
            assert_eq!(shown(first), together, "{middle}");
        }
    }

    #[track_caller]
    fn check_refused(first: &[Line], next: &[Line]) {
        let columns = columns(&["demo", "t", "x"]);
        let mut recorder = recorded(&columns, first);
        let before = format!("{recorder:?}");
        assert!(!recorder.join(recorded(&columns, next)));
        assert_eq!(format!("{recorder:?}"), before);
    }

    #[test]
    fn rows_recorded_apart_are_as_if_recorded_together() {
        let lines = [
            ("a", 1.0, 1.5),
            ("a", 1.0, f64::NAN),
            ("b", 0.0, 2.5),
            ("c", f64::NAN, 3.5),
            ("c", f64::NAN, 4.5),
            ("d", 7.0, 5.5),
            ("d", 8.0, 6.5),
        ];
        check(&["demo", "t", "x"], &lines);
    }

    #[test]
    fn rows_without_a_label_are_one_demonstration() {
        check(&["t", "x"], &[("", 0.0, 1.0), ("", 0.5, 2.0), ("", 0.5, 3.0), ("", 1.0, 4.0)]);
    }

    #[test]
    fn a_label_that_is_back_does_not_follow() {
        check_refused(&[("a", 0.0, 1.0), ("b", 0.0, 1.0)], &[("a", 1.0, 1.0)]);
        check_refused(&[("a", 0.0, 1.0)], &[("b", 0.0, 1.0), ("a", 1.0, 1.0)]);
        check_refused(&[("a", 0.0, 1.0), ("b", 0.0, 1.0)], &[("b", 0.0, 1.0), ("a", 1.0, 1.0)]);
    }

    #[test]
    fn times_that_run_backwards_or_are_known_too_late_do_not_follow() {
        check_refused(&[("a", 1.0, 1.0)], &[("a", 0.5, 1.0)]);
        check_refused(&[("a", 1.0, 1.0)], &[("a", f64::NAN, 1.0), ("a", 2.0, 1.0)]);
        check_refused(&[("a", 1.0, 1.0)], &[("a", f64::NAN, 1.0), ("b", 2.0, 1.0)]);
    }

    #[test]
    fn where_a_demonstration_ended_is_known_of_all() {
        let columns = columns(&["demo", "t", "x"]);
        let mut recorder = recorded(&columns, &[("a", 0.0, 1.0), ("a", 1.0, 1.0)]);
        assert!(recorder.join(recorded(&columns, &[("a", 2.0, 1.0), ("b", 0.0, 1.0), ("c", 0.0, 1.0)])));
        assert!(recorder.join(recorded(&columns, &[("d", 2.0, 1.0)])));
        let ended: Vec<_> = recorder.ended.iter().map(|(label, place)| (label.as_str(), *place)).collect();
        assert_eq!(ended, [("a", 0), ("b", 1), ("c", 2)]);
    }
}
