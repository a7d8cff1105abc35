//! What is known of one subset, and the stages in which it becomes known.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use super::keys::DemonstrationKey;
use super::reading::frames_reached_everywhere;
use super::track_study::{Notes, TrackStudy};
use crate::dbscan::DbscanParameters;
use crate::dwell::{Scales, min_dwell_by, scales_of};
use crate::parallel;
use crate::points::Track;
use crate::rest::{Stay, SubsetRecording, SubsetStays, tell_kinds};
use crate::sub_goal::{
    Clusterings, Method, RadiusRule, SubGoalSearch, find_sub_goals, find_sub_goals_again,
    parameters_left_to_the_engine,
};
use crate::subset::{Setting, SubsetRequest};

/// What is known of one subset in all demonstrations, kept from one inference to the next.
///
/// It becomes known in stages, each of which does nothing where it would do the same again:
///
/// 1. [`look`](Self::look) needs the tracks of this subset alone;
/// 2. [`tell`] needs what has been seen of all subsets, and is cheap;
/// 3. [`search`](Self::search) needs what the first two have left here.
///
/// So the first and the third can be done elsewhere for every subset: [`Seen`], the stays and [`Found`] are what has to
/// travel, and with [`look_through`](Self::look_through) whoever tells need not look.
#[derive(Clone, Debug, Default)]
pub struct SubsetStudy {
    /// Its tracks, cleaned where frames at rest are looked at.
    recording: SubsetRecording,
    method: Method,
    demonstrations: Vec<DemonstrationKey>,
    /// The scales of the tracks before they were cleaned.
    unclean: Scales,
    /// What is known of each track.
    notes: Vec<Notes>,
    /// The stays as this subset alone shows them.
    first_look: Option<SubsetStays>,
    /// The stays as all subsets together show them.
    stays: Option<SubsetStays>,
    left_to_the_engine: OnceLock<DbscanParameters>,
    clusterings: Clusterings,
    found: Option<(SubsetRequest, RadiusRule, Found)>,
}

/// What a [look](SubsetStudy::look) has seen: with the tracks, all that [`tell`] needs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// The scales of the tracks.
    pub unclean: Scales,
    /// The scales of the tracks without their wild detections.
    pub clean: Scales,
    /// For each demonstration the positions in its track of the wild detections, ascending.
    pub wild: Vec<Vec<usize>>,
    /// The stays as the subset alone shows them, where frames at rest are looked at.
    pub stays: Option<SubsetStays>,
}

/// What a [search](SubsetStudy::search) has found: all that [`conclude`](super::conclude) needs of a subset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// The sub-goals, and the clusters that are none.
    pub search: SubGoalSearch,
    /// For each sub-goal and demonstration the frames in which it holds, ascending.
    pub reached: Vec<Vec<Vec<usize>>>,
    /// In how many demonstrations the subset is never observed.
    pub unobserved: usize,
}

impl SubsetStudy {
    /// Looks at the subset `name` with `features` in `demonstrations`. `track` gives the track in the demonstration at a
    /// position; it is asked for those that are not known yet. Gives how many tracks were looked at.
    ///
    /// The scales on which a thing moves and trembles are those of all its tracks. They are [rounded](scales_of), so one
    /// more demonstration mostly leaves them what they are, and then it alone is looked at. Where a scale changes, every
    /// track is looked at anew.
    ///
    /// # Complexity
    ///
    /// O(frames x features) in the tracks that are looked at, and O(T log F) in T others of F frames; O(demonstrations)
    /// where they are those of the last time.
    pub fn look(
        &mut self,
        name: &str,
        features: &[String],
        method: Method,
        demonstrations: &[DemonstrationKey],
        track: impl Fn(usize) -> Track + Sync + Send,
    ) -> usize {
        self.rename(name);
        if self.is_of(features, method, demonstrations) {
            return 0;
        }
        let mut tracks = self.take_tracks(features, demonstrations, track);
        let dimension = tracks.first().map_or(1, |study| study.track.points.dimension());
        parallel::each(&mut tracks, TrackStudy::tally_whole);
        let unclean = scales_of(dimension, tracks.iter().filter_map(TrackStudy::whole));
        let is_at_rest = method == Method::AtRest;
        parallel::each(&mut tracks, |study| study.clean(is_at_rest.then_some(unclean)));
        let clean = scales_of(dimension, tracks.iter().filter_map(TrackStudy::tame));
        let min_dwell = is_at_rest.then(|| {
            let min_dwell =
                min_dwell_by(&mut tracks.iter_mut().map(TrackStudy::with_speeds).collect::<Vec<_>>(), clean);
            parallel::each(&mut tracks, |study| study.find_stays(clean, min_dwell));
            min_dwell
        });
        let were_at: Vec<Option<usize>> = tracks.iter().map(TrackStudy::was_at).collect();
        let mut clusterings = std::mem::take(&mut self.clusterings);
        clusterings.follow(&were_at);
        let first_look = |stays| min_dwell.map(|min_dwell| SubsetStays::first(clean, min_dwell, stays));
        self.take_note(name, features, demonstrations, (unclean, clean), tracks, first_look);
        (self.method, self.clusterings) = (method, clusterings);
        were_at.iter().filter(|was_at| was_at.is_none()).count()
    }

    /// Gives the subset this name.
    pub(super) fn rename(&mut self, name: &str) {
        name.clone_into(&mut self.recording.name);
    }

    /// Comes to where another study is that has [seen](Self::seen) the same in the same tracks.
    ///
    /// # Complexity
    ///
    /// O(demonstrations + wild detections), and the frames of tracks that are not known or have wild detections.
    pub fn look_through(
        &mut self,
        name: &str,
        features: &[String],
        demonstrations: &[DemonstrationKey],
        track: impl Fn(usize) -> Track + Sync + Send,
        seen: Seen,
    ) {
        let mut tracks = self.take_tracks(features, demonstrations, track);
        let by = seen.stays.is_some().then_some(seen.unclean);
        for (study, wild) in tracks.iter_mut().zip(&seen.wild) {
            study.clean_as_told(wild, by);
        }
        self.take_note(name, features, demonstrations, (seen.unclean, seen.clean), tracks, |_| seen.stays);
        self.method = if by.is_some() { Method::AtRest } else { Method::Published };
    }

    /// Puts what a look has told in the place of what was known.
    fn take_note(
        &mut self,
        name: &str,
        features: &[String],
        demonstrations: &[DemonstrationKey],
        (unclean, clean): (Scales, Scales),
        studies: Vec<TrackStudy>,
        first_look: impl FnOnce(Vec<Vec<Stay>>) -> Option<SubsetStays>,
    ) {
        let (mut tracks, mut notes, mut stays) = (Vec::new(), Vec::new(), Vec::new());
        for study in studies {
            let parts = study.into_parts();
            tracks.push(parts.0);
            notes.push(parts.1);
            stays.push(parts.2);
        }
        *self = Self {
            recording: SubsetRecording {
                name: name.to_owned(),
                features: features.to_vec(),
                tracks,
                scales: clean,
            },
            demonstrations: demonstrations.to_vec(),
            unclean,
            notes,
            first_look: first_look(stays),
            ..Self::default()
        };
    }

    /// What the last look has seen.
    pub fn seen(&self) -> Seen {
        Seen {
            unclean: self.unclean,
            clean: self.recording.scales,
            wild: self.notes.iter().map(|notes| notes.wild.positions.clone()).collect(),
            stays: self.first_look.clone(),
        }
    }

    /// Takes note of the stays that [`tell`] has told of the last look; none where every frame is looked at.
    pub fn set_stays(&mut self, stays: Option<SubsetStays>) {
        if self.stays != stays {
            self.stays = stays;
            self.left_to_the_engine = OnceLock::new();
            self.found = None;
        }
    }

    /// The recording and its stays, where frames at rest are looked at.
    pub fn recording(&self) -> (&SubsetRecording, Option<&SubsetStays>) {
        (&self.recording, self.stays.as_ref())
    }

    /// Searches the sub-goals that `request` asks for, and the frames in which they hold.
    ///
    /// # Complexity
    ///
    /// That of [`find_sub_goals`], and O(frames x sub-goals); nothing where the search is [known](Self::is_found).
    pub fn search(&mut self, request: &SubsetRequest, radius: RadiusRule) {
        if self.is_found(request, radius) {
            return;
        }
        let mut clusterings = std::mem::take(&mut self.clusterings);
        let (recording, stays) = self.recording();
        let search = find_sub_goals_again(recording, stays, &self.chosen(request), radius, &mut clusterings);
        let reached = |index: usize| frames_reached_everywhere(&search.found[index].ball, recording, stays);
        let found = Found {
            reached: parallel::map(search.found.len(), reached),
            unobserved: recording.tracks.iter().filter(|track| track.is_empty()).count(),
            search,
        };
        (self.found, self.clusterings) = (Some((request.clone(), radius, found)), clusterings);
    }

    /// Whether the last search was the same, in the same recording and stays.
    pub fn is_found(&self, request: &SubsetRequest, radius: RadiusRule) -> bool {
        self.found.as_ref().is_some_and(|(known, by_rule, _)| known == request && *by_rule == radius)
    }

    /// What the last search has found.
    pub fn found(&self) -> Option<&Found> {
        self.found.as_ref().map(|(_, _, found)| found)
    }

    /// The sub-goals that `request` would give. Nothing is kept.
    ///
    /// # Complexity
    ///
    /// That of [`find_sub_goals`], where what is left to the engine is chosen once only.
    pub fn sub_goals(&self, request: &SubsetRequest, radius: RadiusRule) -> SubGoalSearch {
        let (recording, stays) = self.recording();
        find_sub_goals(recording, stays, &self.chosen(request), radius)
    }

    /// The `request` with what it leaves to the engine.
    fn chosen(&self, request: &SubsetRequest) -> SubsetRequest {
        let (recording, stays) = self.recording();
        let chosen =
            || self.left_to_the_engine.get_or_init(|| parameters_left_to_the_engine(recording, stays));
        let mut request = request.clone();
        if request.epsilon == Setting::Auto {
            request.epsilon = Setting::Fixed(chosen().epsilon);
        }
        if request.min_points == Setting::Auto {
            request.min_points = Setting::Fixed(chosen().min_points);
        }
        request
    }

    /// Whether the last look was at the same: another one would show nothing new.
    pub fn is_of(&self, features: &[String], method: Method, demonstrations: &[DemonstrationKey]) -> bool {
        let is_same = self.recording.features == features && self.method == method;
        is_same && self.demonstrations == demonstrations
    }

    /// The tracks in `demonstrations` with what is known of them. Leaves no track behind.
    fn take_tracks(
        &mut self,
        features: &[String],
        demonstrations: &[DemonstrationKey],
        track: impl Fn(usize) -> Track + Sync + Send,
    ) -> Vec<TrackStudy> {
        let mut known = BTreeMap::new();
        if self.recording.features == features {
            let keys = std::mem::take(&mut self.demonstrations).into_iter();
            known.extend(keys.zip(self.take_studies()));
        }
        let taken: Vec<Option<TrackStudy>> = demonstrations.iter().map(|key| known.remove(key)).collect();
        let new: Vec<usize> = (0..taken.len()).filter(|&index| taken[index].is_none()).collect();
        let mut new_tracks =
            parallel::map(new.len(), |number| TrackStudy::new(track(new[number]))).into_iter();
        taken.into_iter().filter_map(|known| known.or_else(|| new_tracks.next())).collect()
    }

    fn take_studies(&mut self) -> Vec<TrackStudy> {
        let tracks = std::mem::take(&mut self.recording.tracks).into_iter();
        let with_notes = tracks.zip(std::mem::take(&mut self.notes));
        let Some(SubsetStays { scales, min_dwell, demonstrations, .. }) = self.first_look.take() else {
            let study = |(was_at, (track, notes))| TrackStudy::known(was_at, track, notes, None);
            return with_notes.enumerate().map(study).collect();
        };
        let with_stays = with_notes.zip(demonstrations);
        let study = |(was_at, ((track, notes), stays))| {
            TrackStudy::known(was_at, track, notes, Some((scales, min_dwell, stays)))
        };
        with_stays.enumerate().map(study).collect()
    }
}

/// Tells the kinds of the stays of all subsets, which have looked at the same demonstrations.
///
/// # Complexity
///
/// That of [`tell_kinds`].
pub fn tell(subsets: &mut [SubsetStudy]) {
    let first_looks: Option<Vec<SubsetStays>> =
        subsets.iter().map(|subset| subset.first_look.clone()).collect();
    let Some(first_looks) = first_looks else {
        for subset in subsets {
            subset.set_stays(None);
        }
        return;
    };
    // What looks at all subsets wants them in one row; they are moved there and back.
    let recordings: Vec<SubsetRecording> =
        subsets.iter_mut().map(|subset| std::mem::take(&mut subset.recording)).collect();
    let told = tell_kinds(&recordings, first_looks);
    for (subset, (recording, stays)) in subsets.iter_mut().zip(recordings.into_iter().zip(told)) {
        subset.recording = recording;
        subset.set_stays(Some(stays));
    }
}
