//! What is known of one subset, and the stages in which it becomes known.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use super::cleaning::{Wild, joined, split};
use super::keys::DemonstrationKey;
use super::reading::frames_reached_everywhere;
use crate::dbscan::DbscanParameters;
use crate::dwell::{Scales, wild_detections};
use crate::parallel;
use crate::points::Track;
use crate::rest::{SubsetRecording, SubsetStays, first_look, tell_kinds};
use crate::sub_goal::{Method, RadiusRule, SubGoalSearch, find_sub_goals, parameters_left_to_the_engine};
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
    /// What was left out of each track.
    wild: Vec<Wild>,
    /// The stays as this subset alone shows them.
    first_look: Option<SubsetStays>,
    /// The stays as all subsets together show them.
    stays: Option<SubsetStays>,
    left_to_the_engine: OnceLock<DbscanParameters>,
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
    /// position; it is asked for those that are not [known](Self::knows) yet.
    ///
    /// The scales on which a thing moves and trembles are estimated from all its tracks, so one more demonstration means
    /// new scales for all of them, and every track is looked at anew.
    ///
    /// # Complexity
    ///
    /// O(frames x features); O(demonstrations) where they are those of the last time.
    pub fn look(
        &mut self,
        name: &str,
        features: &[String],
        method: Method,
        demonstrations: &[DemonstrationKey],
        track: impl Fn(usize) -> Track + Sync + Send,
    ) {
        name.clone_into(&mut self.recording.name);
        if self.is_of(features, method, demonstrations) {
            return;
        }
        let (before, unclean_before) = (self.method, self.unclean);
        let (tracks, known_wild) = self.take_tracks(features, demonstrations, track);
        let whole = SubsetRecording::new(name, features, tracks);
        let unclean = whole.scales;
        let is_known = before == method && unclean_before == unclean;
        let wild = parallel::map(known_wild.len(), |index| match (&known_wild[index], method) {
            (_, Method::Published) => Vec::new(),
            (Some(positions), Method::AtRest) if is_known => positions.clone(),
            (_, Method::AtRest) => wild_detections(&whole.tracks[index], unclean),
        });
        let (recording, wild) = if wild.iter().all(Vec::is_empty) {
            (whole, vec![Wild::default(); wild.len()])
        } else {
            let (tracks, wild) = split_all(whole.tracks, &wild);
            (SubsetRecording::new(name, features, tracks), wild)
        };
        let first_look = (method == Method::AtRest).then(|| first_look(&recording));
        let demonstrations = demonstrations.to_vec();
        *self = Self { recording, method, demonstrations, unclean, wild, first_look, ..Self::default() };
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
        let (tracks, _) = self.take_tracks(features, demonstrations, track);
        let (tracks, wild) = split_all(tracks, &seen.wild);
        let (name, features, scales) = (name.to_owned(), features.to_vec(), seen.clean);
        *self = Self {
            recording: SubsetRecording { name, features, tracks, scales },
            method: if seen.stays.is_some() { Method::AtRest } else { Method::Published },
            demonstrations: demonstrations.to_vec(),
            unclean: seen.unclean,
            wild,
            first_look: seen.stays,
            ..Self::default()
        };
    }

    /// What the last look has seen.
    pub fn seen(&self) -> Seen {
        Seen {
            unclean: self.unclean,
            clean: self.recording.scales,
            wild: self.wild.iter().map(|wild| wild.positions.clone()).collect(),
            stays: self.first_look.clone(),
        }
    }

    /// Whether the track of `features` in `demonstration` is here.
    pub fn knows(&self, features: &[String], demonstration: DemonstrationKey) -> bool {
        self.recording.features == features && self.demonstrations.contains(&demonstration)
    }

    /// Takes note of the stays that [`tell`] has told; none where every frame is looked at.
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
        let search = self.sub_goals(request, radius);
        let (recording, stays) = self.recording();
        let reached = |index: usize| frames_reached_everywhere(&search.found[index].ball, recording, stays);
        let found = Found {
            reached: parallel::map(search.found.len(), reached),
            unobserved: recording.tracks.iter().filter(|track| track.is_empty()).count(),
            search,
        };
        self.found = Some((request.clone(), radius, found));
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
        let chosen =
            || self.left_to_the_engine.get_or_init(|| parameters_left_to_the_engine(recording, stays));
        let mut request = request.clone();
        if request.epsilon == Setting::Auto {
            request.epsilon = Setting::Fixed(chosen().epsilon);
        }
        if request.min_points == Setting::Auto {
            request.min_points = Setting::Fixed(chosen().min_points);
        }
        find_sub_goals(recording, stays, &request, radius)
    }

    /// Whether the last look was at the same: another one would show nothing new.
    pub fn is_of(&self, features: &[String], method: Method, demonstrations: &[DemonstrationKey]) -> bool {
        let is_same = self.recording.features == features && self.method == method;
        is_same && self.demonstrations == demonstrations
    }

    /// The whole tracks in `demonstrations`, and of those that were known the positions of the wild detections. Leaves no track behind.
    fn take_tracks(
        &mut self,
        features: &[String],
        demonstrations: &[DemonstrationKey],
        track: impl Fn(usize) -> Track + Sync + Send,
    ) -> (Vec<Track>, Vec<Option<Vec<usize>>>) {
        let mut known = BTreeMap::new();
        if self.recording.features == features {
            let tracks = std::mem::take(&mut self.recording.tracks).into_iter();
            let with_wild = tracks.zip(std::mem::take(&mut self.wild));
            known.extend(std::mem::take(&mut self.demonstrations).into_iter().zip(with_wild));
        }
        let taken: Vec<Option<(Track, Wild)>> = demonstrations.iter().map(|key| known.remove(key)).collect();
        let new: Vec<usize> = (0..taken.len()).filter(|&index| taken[index].is_none()).collect();
        let mut new_tracks = parallel::map(new.len(), |number| track(new[number])).into_iter();
        let whole = |known: Option<(Track, Wild)>| match known {
            Some((tame, wild)) => Some((joined(tame, &wild), Some(wild.positions))),
            None => Some((new_tracks.next()?, None)),
        };
        taken.into_iter().filter_map(whole).unzip()
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

/// Every track without its wild detections, and those alone.
fn split_all(tracks: Vec<Track>, wild: &[Vec<usize>]) -> (Vec<Track>, Vec<Wild>) {
    tracks.into_iter().zip(wild).map(|(track, positions)| split(track, positions)).unzip()
}
