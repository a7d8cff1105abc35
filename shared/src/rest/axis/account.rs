//! Whether an axis that the certain rests suggest accounts for all the other stays.

use super::super::{Kind, SubsetRecording, SubsetStays, frames_possible};
use super::{Axis, Verdict, reach};
use crate::points::median;

/// A stay that is shorter than this share of a typical one of those put down is brief.
const BRIEF: f64 = 0.5;

/// Of the stays that an axis explains, at most this share may be long without being put down by it.
const WRONG_AMONG_EXPLAINED: f64 = 0.25;

/// Of the long stays at most this share may not be put down.
const WRONG_AMONG_LONG: f64 = 0.2;

/// What an axis makes of the stays that may be rests or pauses.
pub(super) struct Account {
    /// How often things are known to be left.
    left: usize,
    /// Brief stays that are held by it.
    brief_held: usize,
    /// Stays that are not brief.
    long: usize,
    /// Those of them that it does not explain as put down.
    long_wrong: usize,
}

impl Account {
    /// What an axis in the direction `down`, looked at as far as `share` of the travel, makes of the stays of `members`.
    pub(super) fn of(
        recordings: &[SubsetRecording],
        subsets: &[SubsetStays],
        members: &[usize],
        down: &[f64],
        share: f64,
    ) -> Self {
        let mut stays: Vec<(Kind, Verdict, f64)> = Vec::new();
        for &member in members {
            let axis = Axis { down: down.to_vec(), reach: reach(&subsets[member], share) };
            for (track, of_track) in recordings[member].tracks.iter().zip(&subsets[member].demonstrations) {
                let read = of_track.iter().enumerate().map(|(index, stay)| {
                    (stay.kind, axis.verdict(track, of_track, index), frames_possible(track, &stay.dwell))
                });
                stays.extend(read.filter(|(kind, ..)| *kind != Kind::Start));
            }
        }
        Self::sum_up(&stays)
    }

    fn sum_up(stays: &[(Kind, Verdict, f64)]) -> Self {
        let is_put_down =
            |kind: Kind, verdict: Verdict| kind == Kind::LeftAlone || verdict == Verdict::PutDown;
        let proper = stays.iter().filter(|&&(kind, verdict, _)| is_put_down(kind, verdict));
        let brief = BRIEF * median(proper.map(|&(.., frames)| frames).collect());
        let unclear = || stays.iter().filter(|(kind, ..)| *kind == Kind::Rest);
        let long = || unclear().filter(|(.., frames)| *frames >= brief);
        let is_wrong = |verdict: Verdict| matches!(verdict, Verdict::Unknown | Verdict::Held);
        Self {
            left: stays.iter().filter(|(kind, ..)| *kind == Kind::LeftAlone).count(),
            brief_held: unclear()
                .filter(|(_, verdict, frames)| *frames < brief && *verdict == Verdict::Held)
                .count(),
            long: long().count(),
            long_wrong: long().filter(|(_, verdict, _)| is_wrong(*verdict)).count(),
        }
    }

    /// Whether things hover by it as often as they are left, always briefly, and nearly all that is long is put down: a
    /// way that bends back by chance does not part long stays from brief ones.
    pub(super) fn explains_the_brief_stays(&self) -> bool {
        let explained = (self.brief_held + self.long) as f64;
        2 * self.brief_held >= self.left && self.long_wrong as f64 <= WRONG_AMONG_EXPLAINED * explained
    }

    /// Whether by it a thing is not put down where it stays long: then it is no table that it comes down to.
    pub(super) fn contradicts_the_long_stays(&self) -> bool {
        self.long_wrong as f64 > WRONG_AMONG_LONG * self.long as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brief_hovers_beside_long_rests_are_explained() {
        let stays = [
            (Kind::Rest, Verdict::Held, 5.0),
            (Kind::Rest, Verdict::PutDown, 40.0),
            (Kind::LeftAlone, Verdict::Slid, 50.0),
        ];
        let account = Account::sum_up(&stays);
        assert!(account.explains_the_brief_stays() && !account.contradicts_the_long_stays());
    }

    #[test]
    fn an_axis_by_which_long_stays_are_held_is_contradicted() {
        let stays = [(Kind::Rest, Verdict::Held, 45.0), (Kind::LeftAlone, Verdict::Slid, 50.0)];
        let account = Account::sum_up(&stays);
        assert!(!account.explains_the_brief_stays() && account.contradicts_the_long_stays());
    }
}
