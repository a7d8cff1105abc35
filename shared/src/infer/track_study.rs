//! What is known of one track, and the stages in which it becomes known.

use super::cleaning::{Wild, joined, split};
use crate::dwell::{Scales, Speeds, Tally, wild_detections};
use crate::points::Track;
use crate::rest::{Stay, stays_of_track};

/// What is known of one track besides where it leads: notes that stay true when other tracks come and go.
///
/// Each stage depends on the track and on what all tracks together show, which is noted beside its result; where that is
/// the same, there is nothing to do.
#[derive(Clone, Debug, Default)]
pub(super) struct Notes {
    /// What was left out of the track.
    pub(super) wild: Wild,
    /// The scales by which it is wild; none as published, where nothing is.
    wild_by: Option<Scales>,
    /// What the whole track tells.
    whole: Option<Tally>,
    /// What it tells without what is wild, if that makes a difference.
    tame: Option<Tally>,
    speeds: Speeds,
}

/// A track that is being looked at.
#[derive(Clone, Debug, Default)]
pub(super) struct TrackStudy {
    /// Without what is wild.
    pub(super) track: Track,
    pub(super) notes: Notes,
    /// The stays of a first look, by these scales and this shortest dwell.
    stays: Option<(Scales, usize, Vec<Stay>)>,
    /// Where it was among the tracks of the last time, as long as nothing of it is another.
    was_at: Option<usize>,
}

impl TrackStudy {
    /// A track that nobody has looked at.
    pub(super) fn new(track: Track) -> Self {
        Self { track, ..Self::default() }
    }

    /// A track that was looked at before, where it was then.
    pub(super) fn known(
        was_at: usize,
        track: Track,
        notes: Notes,
        stays: Option<(Scales, usize, Vec<Stay>)>,
    ) -> Self {
        Self { track, notes, stays, was_at: Some(was_at) }
    }

    /// The first stage: what the whole track tells of the scales.
    pub(super) fn tally_whole(&mut self) {
        if self.notes.whole.is_some() {
            return;
        }
        self.notes.whole = Some(if self.notes.wild.positions.is_empty() {
            Tally::of(&self.track)
        } else {
            Tally::of(&joined(self.track.clone(), &self.notes.wild))
        });
    }

    /// The second stage: leaves out what is wild by these scales, and nothing without.
    pub(super) fn clean(&mut self, by: Option<Scales>) {
        if self.notes.wild_by != by {
            let whole = joined(std::mem::take(&mut self.track), &self.notes.wild);
            let positions = by.map(|scales| wild_detections(&whole, scales)).unwrap_or_default();
            self.leave_out(whole, &positions, by);
            self.was_at = None;
        }
        if self.notes.tame.is_none() && !self.notes.wild.positions.is_empty() {
            self.notes.tame = Some(Tally::of(&self.track));
        }
    }

    /// Takes over what somebody else found wild by these scales.
    pub(super) fn clean_as_told(&mut self, positions: &[usize], by: Option<Scales>) {
        if positions != self.notes.wild.positions {
            let whole = joined(std::mem::take(&mut self.track), &self.notes.wild);
            self.leave_out(whole, positions, by);
        }
        self.notes.wild_by = by;
    }

    fn leave_out(&mut self, whole: Track, positions: &[usize], by: Option<Scales>) {
        let is_same = positions == self.notes.wild.positions;
        let notes = std::mem::take(&mut self.notes);
        let (track, wild) = split(whole, positions);
        self.track = track;
        self.notes = if is_same {
            Notes { wild_by: by, ..notes }
        } else {
            self.stays = None;
            Notes { wild, wild_by: by, whole: notes.whole, ..Notes::default() }
        };
    }

    /// The third stage: the stays in the clean track.
    pub(super) fn find_stays(&mut self, scales: Scales, min_dwell: usize) {
        if !self.stays.as_ref().is_some_and(|known| (known.0, known.1) == (scales, min_dwell)) {
            self.stays = Some((scales, min_dwell, stays_of_track(&self.track, scales, min_dwell)));
            self.was_at = None;
        }
    }

    /// What the whole track tells, after the first stage.
    pub(super) fn whole(&self) -> Option<&Tally> {
        self.notes.whole.as_ref()
    }

    /// What the clean track tells, after the second stage.
    pub(super) fn tame(&self) -> Option<&Tally> {
        self.notes.tame.as_ref().or(self.notes.whole.as_ref())
    }

    /// The clean track, and what is known of how fast the thing moves in it.
    pub(super) fn with_speeds(&mut self) -> (&Track, &mut Speeds) {
        (&self.track, &mut self.notes.speeds)
    }

    /// Where it was among the tracks of the last time; none if it is new, or a stage that depends on all tracks had
    /// anything to do.
    pub(super) fn was_at(&self) -> Option<usize> {
        self.was_at
    }

    /// Takes it apart: the clean track, the notes and the stays, none where they were not looked for.
    pub(super) fn into_parts(self) -> (Track, Notes, Vec<Stay>) {
        (self.track, self.notes, self.stays.map(|(.., stays)| stays).unwrap_or_default())
    }
}
