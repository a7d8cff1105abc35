use goalgraph::layout::{Layout, LayoutRequest, adjust, layout};
use goalgraph::pdfa::StateId;

use super::scene::*;

fn labels_apart(layout: &Layout) -> bool {
    let pairs = layout.edges.iter().enumerate();
    let apart = |(at, edge): (usize, _)| {
        layout.edges[at + 1..].iter().all(|other| label(edge).overlap(&label(other)) <= 0.0)
    };
    pairs.into_iter().all(apart)
}

fn labels_clear(layout: &Layout) -> bool {
    let clear = |edge| layout.nodes.iter().all(|node| label(edge).overlap(&rect(node)) <= 0.0);
    layout.edges.iter().all(clear)
}

/// Adds edges to what is laid out, and checks all that should hold in a drawing with room.
fn added(nodes: u32, edges: &[(u32, u32)], more: &[(u32, u32)]) -> (Layout, Layout, LayoutRequest) {
    let before = layout(&request(nodes, edges));
    let request = request(nodes, &[edges, more].concat());
    let after = adjust(&before, &request, &nobody());
    assert_sound(&after, &request);
    assert_eq!(after.nodes, before.nodes);
    assert_eq!(after.edges[..edges.len()], before.edges);
    (before, after, request)
}

#[test]
fn a_new_edge_goes_around_what_is_between() {
    let (_, after, _) = added(5, &[(0, 1), (1, 2), (2, 3), (3, 4)], &[(0, 4), (4, 0), (1, 3)]);
    for edge in &after.edges {
        assert!(met(&after, edge).is_empty(), "{edge:?}");
    }
    assert!(labels_apart(&after) && labels_clear(&after));
}

#[test]
fn parallel_and_opposite_edges_have_labels_apart() {
    let (_, after, _) = added(2, &[(0, 1)], &[(0, 1), (1, 0), (1, 0)]);
    assert!(labels_apart(&after) && labels_clear(&after));
}

#[test]
fn parallel_and_opposite_edges_of_a_moved_state_have_labels_apart() {
    let request = request(3, &[(0, 1), (0, 1), (1, 0), (1, 0), (1, 2)]);
    for (x, y) in [(400.0, 60.0), (-200.0, 10.0), (40.0, 400.0), (90.0, -300.0), (300.0, 350.0)] {
        let after = adjust(&layout(&request), &request, &held([(1, x, y)]));
        assert_sound(&after, &request);
        assert!(labels_apart(&after) && labels_clear(&after), "{x} {y} {after:?}");
    }
}

#[test]
fn new_self_loops_stand_beyond_those_that_stay() {
    let (_, after, _) = added(2, &[(0, 1), (1, 1)], &[(1, 1), (1, 1)]);
    assert!(labels_apart(&after) && labels_clear(&after));
}

#[test]
fn self_loops_move_with_their_state() {
    let request = request(3, &[(0, 1), (1, 1), (1, 1), (1, 2)]);
    let before = layout(&request);
    let old = node_at(&before, 1).clone();
    let after = adjust(&before, &request, &held([(1, old.x + 8.0, old.y + 200.0)]));
    assert_sound(&after, &request);
    for at in [1, 2] {
        assert!((after.edges[at].label.y - before.edges[at].label.y - 200.0).abs() < 1e-6);
    }
}

#[test]
fn an_edge_makes_way_for_a_state_that_is_held_on_it() {
    let request = request(4, &[(0, 1), (0, 2), (0, 3)]);
    let before = layout(&request);
    let middle = before.edges[1].label;
    let after = adjust(&before, &request, &held([(3, middle.x, middle.y)]));
    assert_sound(&after, &request);
    assert!(met(&after, &after.edges[1]).is_empty());
}

#[test]
fn an_edge_that_is_taken_away_leaves_the_others_alone() {
    let edges = [(0, 1), (0, 1), (1, 2), (0, 2), (2, 0)];
    let before = layout(&request(3, &edges));
    for gone in 0..edges.len() {
        let mut request = request(3, &edges);
        request.edges.remove(gone);
        let after = adjust(&before, &request, &nobody());
        let mut expected = before.edges.clone();
        expected.remove(gone);
        assert_eq!(after.edges, expected);
    }
}

#[test]
fn states_that_move_together_keep_the_shape_of_their_edges() {
    let request = request(4, &[(0, 1), (1, 2), (2, 1), (2, 3)]);
    let before = layout(&request);
    let down = |id: u32| (id, node_at(&before, id).x, node_at(&before, id).y + 300.0);
    let after = adjust(&before, &request, &held([down(1), down(2)]));
    assert_sound(&after, &request);
    for at in [1, 2] {
        let (old, new) = (&before.edges[at], &after.edges[at]);
        assert!((new.path[0].control_1.y - old.path[0].control_1.y - 300.0).abs() < 1e-6);
    }
}

#[test]
fn the_start_arrow_moves_with_the_initial_state_and_to_another() {
    let mut request = request(2, &[(0, 1)]);
    let before = layout(&request);
    let after = adjust(&before, &request, &held([(0, 10.0, 400.0)]));
    assert!((after.start.unwrap().arrow.tip.y - 400.0).abs() < 1e-6);
    request.initial = StateId(1);
    let after = adjust(&before, &request, &nobody());
    assert_sound(&after, &request);
    request.initial = StateId(9);
    assert_eq!(adjust(&before, &request, &nobody()).start, None);
}
