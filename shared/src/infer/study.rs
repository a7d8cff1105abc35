//! Inferring again and again from demonstrations and a request that change a little each time.

use super::conclusion::conclude;
use super::keys::{DemonstrationKey, DemonstrationKeys};
use super::objections::requested_subsets;
use super::subset_study::{SubsetStudy, tell};
use super::{InferError, InferRequest, Inference, Progress, RadiusRule};
use crate::demonstration::Demonstration;
use crate::parallel;
use crate::points::Track;
use crate::rest::{SubsetRecording, SubsetStays};
use crate::sub_goal::{Method, SubGoalSearch};
use crate::subset::SubsetRequest;

/// What is known of demonstrations from the last inference, so that the next one costs what has changed since.
///
/// | what changes | what is done again |
/// | --- | --- |
/// | nothing, the name, the semantics | words and automaton |
/// | epsilon, `min_points` or what is restored in a subset | that subset is clustered |
/// | a subset is added, removed or moved | it is looked at and clustered, and so are those whose stays it shows in another light |
/// | the radius rule | every subset is clustered |
/// | a demonstration is added | its own tracks are looked at, and their rests added to the clusters of the others |
/// | a demonstration is removed | every subset is clustered |
/// | and by that a scale, which is rounded | the tracks of that subset are looked at, and it is clustered |
/// | the method | every subset is looked at and clustered |
///
/// Whatever changes, kinds of stays, parameters, balls, words and automaton are made of what is known of all
/// demonstrations: that is in proportion to all. A cluster is searched again, with all of its kind in the subset, where a
/// rest comes in between two or beside noise. Nothing is kept of a demonstration or subset that the last inference was not
/// about.
#[derive(Clone, Debug, Default)]
pub struct Study {
    keys: DemonstrationKeys,
    subsets: Vec<SubsetStudy>,
}

impl Study {
    /// Infers what [`infer`](super::infer) infers from scratch, byte for byte.
    ///
    /// A demonstration is known by [the recording that it shares](Demonstration::is_same_recording): clones are, another
    /// reading of the same file is not.
    ///
    /// # Errors
    ///
    /// Those of [`infer`](super::infer); what is known stays known then.
    ///
    /// # Complexity
    ///
    /// At most that of [`infer`](super::infer). What is kept takes the memory of the tracks and about a fifth more.
    pub fn infer(
        &mut self,
        demonstrations: &[Demonstration],
        request: &InferRequest,
        progress: &mut dyn FnMut(&Progress),
    ) -> Result<Inference, InferError> {
        let subsets = requested_subsets(demonstrations, request)?;
        let steps = Steps { subsets: subsets.len() };
        let keys = self.keys.number(demonstrations);
        let is_other_list = self.take_up(&subsets);
        let is_other_look = self.look(demonstrations, &keys, &subsets, request.method, steps, progress);
        if is_other_list || is_other_look {
            tell(&mut self.subsets);
        }
        self.search(&subsets, request.radius, steps, progress);
        progress(&steps.at("Reading words".to_owned(), 2 * subsets.len()));
        let found: Vec<_> = self.subsets.iter().filter_map(SubsetStudy::found).collect();
        let inference = conclude(demonstrations, request, &found);
        progress(&steps.at("Done".to_owned(), steps.total()));
        Ok(inference)
    }

    /// The sub-goals that the last inference would have found with this `request` for a subset with the same features,
    /// or none if there was no such subset. Nothing is kept: this is for trying parameters.
    ///
    /// # Complexity
    ///
    /// That of [`find_sub_goals`](crate::sub_goal::find_sub_goals) in the one subset.
    pub fn sub_goals(&self, request: &SubsetRequest, radius: RadiusRule) -> Option<SubGoalSearch> {
        Some(self.subset(request)?.sub_goals(request, radius))
    }

    /// What the last inference has looked at in the subset that `request` names: its tracks, and their stays where frames
    /// at rest are looked at. None if there was no such subset.
    pub fn recording(&self, request: &SubsetRequest) -> Option<(&SubsetRecording, Option<&SubsetStays>)> {
        Some(self.subset(request)?.recording())
    }

    fn subset(&self, request: &SubsetRequest) -> Option<&SubsetStudy> {
        let is_it = |subset: &&SubsetStudy| {
            let (recording, _) = subset.recording();
            recording.name == request.name && recording.features == request.features
        };
        self.subsets.iter().find(is_it)
    }

    /// Puts what is known of `subsets` in their order and forgets the others. Tells whether the list is another one.
    fn take_up(&mut self, subsets: &[SubsetRequest]) -> bool {
        let mut known: Vec<Option<SubsetStudy>> =
            std::mem::take(&mut self.subsets).into_iter().map(Some).collect();
        let mut is_other = known.len() != subsets.len();
        for (index, request) in subsets.iter().enumerate() {
            let position = |is_it: &dyn Fn(&SubsetRecording) -> bool| {
                known.iter().position(|known| known.as_ref().is_some_and(|it| is_it(it.recording().0)))
            };
            let same_features = |recording: &SubsetRecording| recording.features == request.features;
            let same =
                |recording: &SubsetRecording| recording.name == request.name && same_features(recording);
            let exact = position(&same);
            is_other |= exact != Some(index);
            let known = exact.or_else(|| position(&same_features)).and_then(|at| known[at].take());
            self.subsets.push(known.unwrap_or_default());
        }
        is_other
    }

    /// Looks at the subsets in the demonstrations; tells whether there was anything new to see.
    fn look(
        &mut self,
        demonstrations: &[Demonstration],
        keys: &[DemonstrationKey],
        subsets: &[SubsetRequest],
        method: Method,
        steps: Steps,
        progress: &mut dyn FnMut(&Progress),
    ) -> bool {
        let pairs = self.subsets.iter_mut().zip(subsets);
        let is_new = |(study, request): &(&mut SubsetStudy, &SubsetRequest)| {
            !study.is_of(&request.features, method, keys)
        };
        let (mut new, known): (Vec<_>, Vec<_>) = pairs.partition(is_new);
        let mut done = known.len();
        for (study, request) in known {
            study.rename(&request.name);
        }
        for part in new.chunks_mut(parallel::AT_ONCE) {
            progress(&steps.at(stage("Looking at", part), done));
            parallel::each(part, |(study, request)| {
                let track = |index: usize| Track::of_features(&demonstrations[index], &request.features);
                study.look(&request.name, &request.features, method, keys, track);
            });
            done += part.len();
        }
        !new.is_empty()
    }

    fn search(
        &mut self,
        subsets: &[SubsetRequest],
        radius: RadiusRule,
        steps: Steps,
        progress: &mut dyn FnMut(&Progress),
    ) {
        let pairs = self.subsets.iter_mut().zip(subsets);
        let is_new = |(study, request): &(&mut SubsetStudy, &SubsetRequest)| !study.is_found(request, radius);
        let mut new: Vec<_> = pairs.filter(is_new).collect();
        let mut done = 2 * subsets.len() - new.len();
        for part in new.chunks_mut(parallel::AT_ONCE) {
            progress(&steps.at(stage("Clustering", part), done));
            parallel::each(part, |(study, request)| study.search(request, radius));
            done += part.len();
        }
    }
}

/// The steps of an inference: every subset is looked at and clustered, and then the words are read.
#[derive(Clone, Copy)]
struct Steps {
    subsets: usize,
}

impl Steps {
    fn total(self) -> usize {
        2 * self.subsets + 1
    }

    fn at(self, stage: String, done: usize) -> Progress {
        Progress { stage, done, total: self.total() }
    }
}

/// What is done to the subsets that are worked on at once.
fn stage(doing: &str, part: &[(&mut SubsetStudy, &SubsetRequest)]) -> String {
    match part {
        [(_, only)] => format!("{doing} {}", only.name),
        _ => format!("{doing} {} subsets", part.len()),
    }
}
