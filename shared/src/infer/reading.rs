//! The words of demonstrations in an alphabet that is there already.

use super::keys::DemonstrationKey;
use super::subset_study::{SubsetStudy, tell};
use crate::demonstration::Demonstration;
use crate::parallel;
use crate::pdfa::Word;
use crate::points::Track;
use crate::rest::{Stay, SubsetRecording, SubsetStays};
use crate::specification::{Ball, Specification};
use crate::sub_goal::{Method, frames_reached};
use crate::word::{Reached, read_word};

/// For each demonstration the frames in which a sub-goal with `ball` holds.
pub(super) fn frames_reached_everywhere(
    ball: &Ball,
    recording: &SubsetRecording,
    stays: Option<&SubsetStays>,
) -> Vec<Vec<usize>> {
    // Where nothing is ever put down, an expert has restored a place of another kind: then every stay counts.
    let is_rest = |stay: &Stay| stay.kind.is_rest() && ball.contains(&stay.dwell.center);
    let is_resting_place = stays.is_some_and(|stays| stays.demonstrations.iter().flatten().any(is_rest));
    let in_demonstration = |(demonstration, track): (usize, &Track)| {
        let stays = stays.map(|stays| stays.demonstrations[demonstration].as_slice());
        frames_reached(ball, track, stays, |kind| kind.is_rest() || !is_resting_place)
    };
    recording.tracks.iter().enumerate().map(in_demonstration).collect()
}

/// Reads the word of each demonstration in the alphabet of a specification that is there already: by rests where it was
/// inferred by rests ([`min_dwell`](crate::specification::SubsetParameters::min_dwell) above 1), as published otherwise.
///
/// Sub-goals without a ball are never reached, nor are those whose features a demonstration does not have.
///
/// # Complexity
///
/// O(F · A) for F observed frames and A sub-goals, and that of [`stays`](crate::rest::stays).
pub fn read_words(specification: &Specification, demonstrations: &[Demonstration]) -> Vec<Word> {
    let parameters = &specification.subsets;
    let by_rests = parameters.iter().any(|subset| subset.min_dwell > 1);
    let method = if by_rests { Method::AtRest } else { Method::Published };
    let keys: Vec<DemonstrationKey> =
        (0..demonstrations.len()).map(|index| DemonstrationKey(index as u64)).collect();
    let mut subsets = parallel::map(parameters.len(), |index| {
        let (name, features) = (&parameters[index].name, &parameters[index].features);
        let mut subset = SubsetStudy::default();
        let track = |index: usize| Track::of_features(&demonstrations[index], features);
        subset.look(name, features, method, &keys, track);
        subset
    });
    tell(&mut subsets);
    let in_ball = |ball: &Ball| {
        let index = parameters.iter().position(|subset| subset.name == ball.subset)?;
        let (recording, stays) = subsets[index].recording();
        Some(frames_reached_everywhere(ball, recording, stays))
    };
    let of_sub_goals = specification.sub_goals.iter();
    let reached: Vec<(_, Vec<Vec<usize>>)> =
        of_sub_goals.filter_map(|sub_goal| Some((sub_goal.id, in_ball(sub_goal.ball.as_ref()?)?))).collect();
    let word = |demonstration: usize| {
        let reached = reached
            .iter()
            .map(|(symbol, frames)| Reached { symbol: *symbol, frames: &frames[demonstration] });
        read_word(&reached.collect::<Vec<_>>())
    };
    (0..demonstrations.len()).map(word).collect()
}
