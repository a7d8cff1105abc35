//! Demonstrations as the subsets of a specification see them, and the words read from them.

use crate::demonstration::Demonstration;
use crate::pdfa::Word;
use crate::points::Track;
use crate::rest::{Stay, SubsetRecording, SubsetStays, stays};
use crate::specification::{Ball, Specification};
use crate::sub_goal::{Method, frames_reached};
use crate::word::{Reached, read_word};

/// The recordings of all subsets, with their stays where frames at rest are looked at.
pub(super) struct Reading {
    recordings: Vec<SubsetRecording>,
    stays: Option<Vec<SubsetStays>>,
}

impl Reading {
    /// Looks at `demonstrations` through `subsets`: name and features of each.
    pub(super) fn new(
        demonstrations: &[Demonstration],
        subsets: &[(&str, &[String])],
        method: Method,
    ) -> Self {
        let recording = |&(name, features): &(&str, &[String])| {
            let track = |demonstration: &Demonstration| {
                let columns = features.iter().filter_map(|name| demonstration.feature_index(name));
                Track::new(demonstration, &columns.collect::<Vec<_>>())
            };
            SubsetRecording::new(name, features, demonstrations.iter().map(track).collect())
        };
        let recordings = subsets.iter().map(recording);
        match method {
            Method::Published => Self { recordings: recordings.collect(), stays: None },
            Method::AtRest => {
                let recordings: Vec<_> = recordings.map(|recording| recording.cleaned()).collect();
                let stays = stays(&recordings);
                Self { recordings, stays: Some(stays) }
            }
        }
    }

    /// The recording of subset `index`, and its stays where frames at rest are looked at.
    pub(super) fn subset(&self, index: usize) -> (&SubsetRecording, Option<&SubsetStays>) {
        (&self.recordings[index], self.stays.as_ref().map(|stays| &stays[index]))
    }

    /// For each demonstration the frames in which a sub-goal with `ball` in subset `index` holds.
    pub(super) fn frames_reached(&self, index: usize, ball: &Ball) -> Vec<Vec<usize>> {
        let (recording, stays) = self.subset(index);
        // Where nothing is ever put down, an expert has restored a place of another kind: then every stay counts.
        let is_rest = |stay: &&Stay| stay.kind.is_rest() && ball.contains(&stay.dwell.center);
        let is_resting_place =
            stays.is_some_and(|stays| stays.demonstrations.iter().flatten().any(|it| is_rest(&it)));
        let in_demonstration = |(demonstration, track): (usize, &Track)| {
            let stays = stays.map(|stays| stays.demonstrations[demonstration].as_slice());
            frames_reached(ball, track, stays, |kind| kind.is_rest() || !is_resting_place)
        };
        recording.tracks.iter().enumerate().map(in_demonstration).collect()
    }
}

/// Reads the word of each demonstration in the alphabet of a specification that is there already: by rests where it was
/// inferred by rests ([`min_dwell`](crate::specification::SubsetParameters::min_dwell) above 1), as published otherwise.
///
/// Sub-goals without a ball are never reached, nor are those whose features a demonstration does not have.
///
/// # Complexity
///
/// O(F · A) for F observed frames and A sub-goals, and that of [`stays`].
pub fn read_words(specification: &Specification, demonstrations: &[Demonstration]) -> Vec<Word> {
    let subsets = &specification.subsets;
    let parts: Vec<(&str, &[String])> =
        subsets.iter().map(|subset| (subset.name.as_str(), subset.features.as_slice())).collect();
    let by_rests = subsets.iter().any(|subset| subset.min_dwell > 1);
    let method = if by_rests { Method::AtRest } else { Method::Published };
    let reading = Reading::new(demonstrations, &parts, method);
    let reached: Vec<(_, Vec<Vec<usize>>)> = specification
        .sub_goals
        .iter()
        .filter_map(|sub_goal| {
            let ball = sub_goal.ball.as_ref()?;
            let index = subsets.iter().position(|subset| subset.name == ball.subset)?;
            Some((sub_goal.id, reading.frames_reached(index, ball)))
        })
        .collect();
    let word = |demonstration: usize| {
        let of_sub_goal = |(symbol, frames): &(_, Vec<Vec<usize>>)| Reached {
            symbol: *symbol,
            frames: frames[demonstration].clone(),
        };
        read_word(&reached.iter().map(of_sub_goal).collect::<Vec<_>>())
    };
    (0..demonstrations.len()).map(word).collect()
}
