//! Which clusters are eliminated in small recordings.

use super::*;
use crate::points::{Points, Track};
use crate::rest::stays;
use crate::sub_goal::{SubGoalSearch, find_sub_goals};
use crate::subset::{Setting, SubsetRequest};

/// A thing on a line: in each demonstration, where it is and for how many frames.
fn recording(demonstrations: &[&[(f64, usize)]]) -> SubsetRecording {
    let track = |stretches: &&[(f64, usize)]| {
        let x: Vec<f64> = stretches.iter().flat_map(|&(x, frames)| vec![x; frames]).collect();
        Track::observed_throughout(Points::from_rows(1, x))
    };
    SubsetRecording::new("red", &["red.x".to_owned()], demonstrations.iter().map(track).collect())
}

fn request(epsilon: Setting<f64>, min_points: Setting<usize>) -> SubsetRequest {
    let features = vec!["red.x".to_owned()];
    SubsetRequest { name: "red".to_owned(), features, epsilon, min_points, restored: Vec::new() }
}

fn centers(search: &SubGoalSearch) -> Vec<f64> {
    search.found.iter().map(|cluster| cluster.ball.center[0]).collect()
}

fn reasons(search: &SubGoalSearch) -> Vec<(f64, &str)> {
    let pairs = search.eliminated.iter();
    pairs.map(|it| (it.cluster.ball.center[0], it.reason.as_str())).collect()
}

fn at_rest(demonstrations: &[&[(f64, usize)]]) -> SubGoalSearch {
    let recording = recording(demonstrations);
    let stays = &stays(std::slice::from_ref(&recording))[0];
    find_sub_goals(&recording, Some(stays), &request(Setting::Auto, Setting::Auto), RadiusRule::Robust)
}

#[test]
fn a_cluster_that_holds_the_first_observed_state_is_eliminated() {
    let recording = recording(&[&[(0.0, 10), (0.5, 1), (1.0, 10)], &[(0.0, 10), (1.0, 10)], &[(1.0, 10)]]);
    let request = request(Setting::Fixed(0.1), Setting::Fixed(5));
    let search = find_sub_goals(&recording, None, &request, RadiusRule::Largest);
    assert_eq!(centers(&search), [0.0; 0]);
    let expected = [(0.0, "2 of 3 demonstrations start here"), (1.0, "1 of 3 demonstrations start here")];
    assert_eq!(reasons(&search), expected);
}

#[test]
fn places_where_demonstrations_only_start_are_shown() {
    let way: &[(f64, usize)] = &[(0.0, 20), (0.5, 1), (1.0, 20)];
    let search = at_rest(&[way, way, way]);
    assert_eq!(centers(&search), [1.0]);
    assert_eq!(reasons(&search), [(0.0, "3 of 3 demonstrations start here")]);
}

#[test]
fn an_eliminated_cluster_is_a_sub_goal_again_when_the_expert_restores_it() {
    let way: &[(f64, usize)] = &[(0.0, 20), (0.5, 1), (1.0, 20)];
    let recording = recording(&[way, way, way]);
    let stays = &stays(std::slice::from_ref(&recording))[0];
    let mut request = request(Setting::Auto, Setting::Auto);
    request.restored = vec![vec![0.0]];
    let search = find_sub_goals(&recording, Some(stays), &request, RadiusRule::Robust);
    assert_eq!(centers(&search), [1.0, 0.0]);
    assert_eq!(reasons(&search), []);
}

#[test]
fn a_start_of_one_demonstration_alone_is_not_shown() {
    let search = at_rest(&[&[(0.0, 20), (0.5, 1), (1.0, 20)], &[(0.2, 20), (0.5, 1), (1.0, 20)]]);
    assert_eq!(centers(&search), [1.0]);
    assert_eq!(reasons(&search), []);
}

#[test]
fn pauses_of_most_demonstrations_are_shown() {
    let pauses: &[(f64, usize)] = &[(0.0, 30), (0.5, 1), (1.0, 5), (1.5, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
    let search = at_rest(&[pauses, pauses, pauses]);
    assert_eq!(centers(&search), [2.0, 3.0]);
    let expected =
        [(0.0, "3 of 3 demonstrations start here"), (1.0, "3 of 3 demonstrations hold it here on the way")];
    assert_eq!(reasons(&search), expected);
}

#[test]
fn a_place_where_more_demonstrations_pause_than_rest_is_eliminated() {
    let pause: &[(f64, usize)] = &[(0.0, 30), (0.5, 1), (1.0, 5), (1.5, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
    let rest: &[(f64, usize)] = &[(0.0, 30), (0.5, 1), (1.0, 30), (1.5, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
    let search = at_rest(&[pause, pause, pause, rest, rest]);
    assert_eq!(centers(&search), [2.0, 3.0]);
    assert_eq!(reasons(&search)[0], (1.0, "3 of 5 demonstrations hold it here on the way"));
}

#[test]
fn a_stop_of_one_demonstration_is_eliminated() {
    let way: &[(f64, usize)] = &[(0.0, 30), (1.0, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
    let stop: &[(f64, usize)] = &[(0.0, 30), (1.0, 30), (1.5, 1), (2.0, 30), (2.5, 1), (3.0, 30)];
    let search = at_rest(&[way, way, way, stop]);
    assert_eq!(centers(&search), [2.0, 3.0]);
    assert_eq!(reasons(&search)[0], (1.0, "only 1 of 4 demonstrations rest here"));
}
