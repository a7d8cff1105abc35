//! An inference whose pieces are done by others, kept so that the next one costs what has changed. No browser here.

use goalgraph::demonstration::Demonstration;
use goalgraph::infer::{
    DemonstrationKey, Found, InferError, InferRequest, Inference, Seen, SubsetStudy, conclude,
    requested_subsets, tell,
};
use goalgraph::points::Track;
use goalgraph::subset::SubsetRequest;

use super::looking::{clusters, curve_of};
use super::piece::{Look, Piece, Search, values_of};
use crate::protocol::{FromWorker, SubsetOf, ToWorker};

/// What is known of the subsets of some demonstrations.
///
/// The stages follow each other: [`begin`](Self::begin), the pieces [`to_look`](Self::to_look), [`tell`](Self::tell), the
/// pieces [`to_search`](Self::to_search), [`conclude`](Self::conclude).
#[derive(Default)]
pub(super) struct SharedStudy {
    demonstrations: Vec<Demonstration>,
    parts: Vec<Part>,
}

/// One subset.
struct Part {
    request: SubsetRequest,
    look: Look,
    /// Whether it was looked at.
    seen: bool,
    study: SubsetStudy,
    search: Option<(Search, Found)>,
}

impl SharedStudy {
    /// Takes up `request`; what is known of other demonstrations and subsets is forgotten.
    ///
    /// # Errors
    ///
    /// Those of [`goalgraph::infer::infer`].
    pub(super) fn begin(
        &mut self,
        demonstrations: Vec<Demonstration>,
        request: &InferRequest,
    ) -> Result<(), InferError> {
        let subsets = requested_subsets(&demonstrations, request)?;
        let is_same = self.is_in(&demonstrations);
        let mut known = if is_same { std::mem::take(&mut self.parts) } else { Vec::new() };
        self.demonstrations = demonstrations;
        let part = |subset: SubsetRequest| {
            let (name, features) = (subset.name.clone(), subset.features.clone());
            let look = Look { name, features, method: request.method };
            match known.iter().position(|part| part.look == look) {
                Some(index) => Part { request: subset, ..known.swap_remove(index) },
                None => {
                    Part { request: subset, look, seen: false, study: SubsetStudy::default(), search: None }
                }
            }
        };
        self.parts = subsets.into_iter().map(part).collect();
        Ok(())
    }

    /// The answer to a `request` about one subset in `demonstrations`; none where it is about something else, or they were
    /// not looked at in this way.
    pub(super) fn answer(&self, demonstrations: &[Demonstration], request: &ToWorker) -> Option<FromWorker> {
        match request {
            ToWorker::KDistances { of, neighbor, number } => {
                let curve = curve_of(self.subset(demonstrations, of)?.recording(), *neighbor);
                Some(FromWorker::KDistances { number: *number, result: Ok(curve) })
            }
            ToWorker::Preview { of, number } => {
                let search = self.subset(demonstrations, of)?.sub_goals(&of.subset, of.request.radius);
                Some(FromWorker::Previewed { number: *number, result: Ok(clusters(search)) })
            }
            _ => None,
        }
    }

    /// What is known of a subset, where it was looked at beside the same others.
    fn subset(&self, demonstrations: &[Demonstration], of: &SubsetOf) -> Option<&SubsetStudy> {
        let is_of = |(part, subset): (&Part, &SubsetRequest)| {
            let Look { name, features, method } = &part.look;
            part.seen && (name, features, *method) == (&subset.name, &subset.features, of.request.method)
        };
        let is_it =
            |part: &&Part| part.look.name == of.subset.name && part.look.features == of.subset.features;
        let subsets = &of.request.subsets;
        let is_known = self.is_in(demonstrations)
            && self.parts.len() == subsets.len()
            && self.parts.iter().zip(subsets).all(is_of);
        self.parts.iter().find(is_it).filter(|_| is_known).map(|part| &part.study)
    }

    /// Whether these are the demonstrations.
    fn is_in(&self, demonstrations: &[Demonstration]) -> bool {
        let mut pairs = self.demonstrations.iter().zip(demonstrations);
        self.demonstrations.len() == demonstrations.len()
            && pairs.all(|(one, other)| one.is_same_recording(other))
    }

    /// How many subsets there are.
    pub(super) fn subsets(&self) -> usize {
        self.parts.len()
    }

    /// The subsets that nobody has looked at yet.
    pub(super) fn to_look(&self) -> Vec<usize> {
        (0..self.parts.len()).filter(|&index| !self.parts[index].seen).collect()
    }

    /// What to look at in a subset, and the values for it.
    pub(super) fn look(&self, index: usize) -> (Piece, Vec<f64>) {
        let look = self.parts[index].look.clone();
        let tracks: Vec<Track> =
            self.demonstrations.iter().map(|it| Track::of_features(it, &look.features)).collect();
        let (lengths, values) = values_of(&tracks);
        (Piece::Look { look, lengths }, values)
    }

    /// Takes note of what was seen in a subset.
    pub(super) fn saw(&mut self, index: usize, seen: Seen) {
        let keys: Vec<DemonstrationKey> =
            (0..self.demonstrations.len()).map(|number| DemonstrationKey(number as u64)).collect();
        let (part, demonstrations) = (&mut self.parts[index], &self.demonstrations);
        let Look { name, features, .. } = &part.look;
        let track = |number: usize| Track::of_features(&demonstrations[number], features);
        part.study.look_through(name, features, &keys, track, seen);
        part.seen = true;
    }

    /// Tells what the subsets show of each other.
    pub(super) fn tell(&mut self) {
        let mut studies: Vec<SubsetStudy> =
            self.parts.iter_mut().map(|part| std::mem::take(&mut part.study)).collect();
        tell(&mut studies);
        for (part, study) in self.parts.iter_mut().zip(studies) {
            part.study = study;
        }
    }

    /// The subsets whose sub-goals are not known as `request` asks for them.
    pub(super) fn to_search(&self, request: &InferRequest) -> Vec<(usize, Search)> {
        let search = |part: &Part| {
            let (recording, stays) = part.study.recording();
            Search {
                request: part.request.clone(),
                radius: request.radius,
                scales: recording.scales,
                stays: stays.cloned(),
            }
        };
        let searches = self.parts.iter().map(search).enumerate();
        let is_new = |(index, search): &(usize, Search)| {
            self.parts[*index].search.as_ref().is_none_or(|(known, _)| known != search)
        };
        searches.filter(is_new).collect()
    }

    /// A search in a subset, and the values for it.
    pub(super) fn search(&self, index: usize, search: &Search) -> (Piece, Vec<f64>) {
        let (recording, _) = self.parts[index].study.recording();
        let (lengths, values) = values_of(&recording.tracks);
        (Piece::Search { search: search.clone(), lengths }, values)
    }

    /// Takes note of what a search has found.
    pub(super) fn found(&mut self, index: usize, search: Search, found: Found) {
        self.parts[index].search = Some((search, found));
    }

    /// The inference, once every subset is searched.
    pub(super) fn conclude(&self, request: &InferRequest) -> Inference {
        let found: Vec<&Found> =
            self.parts.iter().filter_map(|part| part.search.as_ref().map(|(_, found)| found)).collect();
        conclude(&self.demonstrations, request, &found)
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use goalgraph::infer::{Method, infer};
    use goalgraph::subset::Setting;

    use super::*;
    use crate::protocol::{FileId, decode, encode};
    use crate::worker::piece::Outcome;
    use crate::worker::reading::{Content, read};
    use crate::worker::recordings::Recordings;

    /// Recordings in which two things are carried to places that differ a little.
    fn recordings(count: usize) -> Vec<Demonstration> {
        let recording = |number: usize| {
            let mut table = String::from("a.x,a.y,b.x,b.y\n");
            for frame in 0..160_usize {
                let at = |begin: usize| (frame.saturating_sub(begin).min(20) as f64) / 20.0;
                let shake = ((frame * 7 + number * 3) % 5) as f64 / 1000.0;
                let gap = if frame == 90 + number { String::new() } else { format!("{:.4}", at(70) + shake) };
                let _ = writeln!(table, "{:.4},{shake:.4},{shake:.4},{gap}", at(20 + number) + shake);
            }
            let Ok(Content::Demonstrations(read)) = read(&format!("{number}.csv"), table.as_bytes(), None)
            else {
                panic!("{table}")
            };
            read
        };
        (0..count).flat_map(recording).collect()
    }

    /// Infers piece by piece, each sent there and back; gives how many pieces there were.
    fn infer_in_pieces(
        study: &mut SharedStudy,
        demonstrations: &[Demonstration],
        request: &InferRequest,
    ) -> (Inference, usize) {
        let perform = |(piece, values): (Piece, Vec<f64>)| {
            let piece: Piece = decode(&encode(&piece)).unwrap();
            decode::<Outcome>(&encode(&piece.perform(&values))).unwrap()
        };
        study.begin(demonstrations.to_vec(), request).unwrap();
        let looks = study.to_look();
        for &index in &looks {
            let Outcome::Seen(seen) = perform(study.look(index)) else { panic!("nothing seen") };
            study.saw(index, seen);
        }
        study.tell();
        let searches = study.to_search(request);
        let pieces = looks.len() + searches.len();
        for (index, search) in searches {
            let Outcome::Found(Some(found)) = perform(study.search(index, &search)) else {
                panic!("nothing found")
            };
            study.found(index, search, found);
        }
        (study.conclude(request), pieces)
    }

    #[test]
    fn pieces_give_what_the_whole_gives() {
        let demonstrations = recordings(4);
        for method in [Method::AtRest, Method::Published] {
            let request = InferRequest { method, ..InferRequest::default() };
            let (inference, pieces) = infer_in_pieces(&mut SharedStudy::default(), &demonstrations, &request);
            assert_eq!(Ok(inference), infer(&demonstrations, &request, &mut |_| ()));
            assert_eq!(pieces, 4);
        }
    }

    #[test]
    fn only_what_has_changed_is_done_again() {
        let demonstrations = recordings(4);
        let mut study = SharedStudy::default();
        let mut request = InferRequest::default();
        let mut check = |demonstrations: &[Demonstration], request: &InferRequest, expected: usize| {
            let (inference, pieces) = infer_in_pieces(&mut study, demonstrations, request);
            assert_eq!(Ok(inference), infer(demonstrations, request, &mut |_| ()));
            assert_eq!(pieces, expected);
        };
        check(&demonstrations, &request, 4);
        check(&demonstrations, &request, 0);
        request.subsets = requested_subsets(&demonstrations, &request).unwrap();
        check(&demonstrations, &request, 0);
        request.subsets[0].epsilon = Setting::Fixed(0.02);
        check(&demonstrations, &request, 1);
        check(&demonstrations[1..], &request, 4);
        request.subsets.truncate(1);
        check(&demonstrations[1..], &request, 1);
    }

    #[test]
    fn a_subset_is_told_of_as_if_it_was_not_shared() {
        let demonstrations = recordings(4);
        let (mut study, request) = (SharedStudy::default(), InferRequest::default());
        infer_in_pieces(&mut study, &demonstrations, &request);
        let mut kept = Recordings::default();
        kept.keep(FileId(0), Ok(Content::Demonstrations(demonstrations.clone())));

        let subsets = requested_subsets(&demonstrations, &request).unwrap();
        let request = InferRequest { subsets: subsets.clone(), ..request };
        for subset in subsets {
            let subset = SubsetRequest { epsilon: Setting::Fixed(0.02), ..subset };
            let of = SubsetOf { files: vec![FileId(0)], request: request.clone(), subset };
            let curve = ToWorker::KDistances { of: of.clone(), neighbor: 4, number: 7 };
            let preview = ToWorker::Preview { of, number: 8 };
            for asked in [curve, preview] {
                let answer = study.answer(&demonstrations, &asked).unwrap();
                assert_eq!(study.answer(&demonstrations[1..], &asked), None);
                kept.serve(asked, &mut |expected| assert_eq!(answer, expected));
            }
        }
    }

    #[test]
    fn a_subset_that_was_looked_at_otherwise_is_not_told_of() {
        let demonstrations = recordings(4);
        let (mut study, request) = (SharedStudy::default(), InferRequest::default());
        let subsets = requested_subsets(&demonstrations, &request).unwrap();
        let asked = |request: InferRequest| {
            let of = SubsetOf { files: vec![FileId(0)], subset: request.subsets[0].clone(), request };
            ToWorker::Preview { of, number: 1 }
        };
        let all = InferRequest { subsets, ..request.clone() };
        assert_eq!(study.answer(&demonstrations, &asked(all.clone())), None);
        infer_in_pieces(&mut study, &demonstrations, &request);
        assert!(study.answer(&demonstrations, &asked(all.clone())).is_some());
        let published = InferRequest { method: Method::Published, ..all.clone() };
        assert_eq!(study.answer(&demonstrations, &asked(published)), None);
        let one = InferRequest { subsets: all.subsets[..1].to_vec(), ..all };
        assert_eq!(study.answer(&demonstrations, &asked(one)), None);
    }

    #[test]
    fn what_cannot_be_inferred_is_refused_as_ever() {
        let (mut study, request) = (SharedStudy::default(), InferRequest::default());
        assert_eq!(study.begin(Vec::new(), &request), Err(InferError::NoDemonstrations));
    }
}
