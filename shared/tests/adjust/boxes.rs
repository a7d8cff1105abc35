use goalgraph::layout::{Direction, Layout, NodeBox, Point, adjust, layout};
use goalgraph::pdfa::StateId;

use super::scene::*;

#[test]
fn an_unchanged_request_gives_the_layout_before() {
    let request = request(6, &[(0, 1), (1, 2), (2, 2), (2, 3), (0, 4), (4, 0), (4, 0), (3, 5), (0, 5)]);
    let before = layout(&request);
    assert_eq!(adjust(&before, &request, &nobody()), before);
}

#[test]
fn nothing_before_gives_a_whole_layout() {
    let request = request(3, &[(0, 1), (1, 2)]);
    assert_eq!(adjust(&Layout::default(), &request, &nobody()), layout(&request));
    let dragged = adjust(&Layout::default(), &request, &held([(2, 9.0, -70.5)]));
    assert_eq!((node_at(&dragged, 2).x, node_at(&dragged, 2).y), (9.0, -70.5));
}

#[test]
fn no_request_gives_an_empty_drawing() {
    let before = layout(&request(3, &[(0, 1), (1, 2)]));
    let after = adjust(&before, &request(0, &[]), &nobody());
    assert!(after.nodes.is_empty() && after.edges.is_empty() && after.start.is_none());
}

#[test]
fn a_held_state_is_exactly_there_and_the_frame_follows() {
    let request = request(3, &[(0, 1), (1, 2)]);
    let after = adjust(&layout(&request), &request, &held([(1, -123.456, -77.7)]));
    assert_sound(&after, &request);
    assert_eq!((node_at(&after, 1).x, node_at(&after, 1).y), (-123.456, -77.7));
    assert!(after.left < -123.456 && after.top < -77.7);
}

#[test]
fn a_state_held_over_another_moves_nothing() {
    let request = request(3, &[(0, 1), (1, 2)]);
    let before = layout(&request);
    let under = node_at(&before, 2);
    let after = adjust(&before, &request, &held([(1, under.x + 5.0, under.y)]));
    assert_sound(&after, &request);
    assert_eq!(overlapping(&after), [(StateId(1), StateId(2))]);
    assert_eq!(node_at(&after, 2), under);
}

#[test]
fn a_new_state_stands_after_the_one_that_leads_to_it() {
    let before = layout(&request(3, &[(0, 1), (0, 2)]));
    let request = request(4, &[(0, 1), (0, 2), (1, 3)]);
    let after = adjust(&before, &request, &nobody());
    assert_sound(&after, &request);
    assert_eq!(after.nodes[..3], before.nodes);
    assert!(overlapping(&after).is_empty());
    let (new, old) = (node_at(&after, 3), node_at(&after, 1));
    assert!(new.x > old.x + old.width && (new.y - old.y).abs() < 60.0, "{new:?} {old:?}");
}

#[test]
fn a_new_state_without_neighbors_stands_below() {
    let before = layout(&request(3, &[(0, 1), (1, 2)]));
    let request = request(4, &[(0, 1), (1, 2)]);
    let after = adjust(&before, &request, &nobody());
    assert_sound(&after, &request);
    assert!(after.nodes[..3].iter().all(|node| rect(node).bottom < rect(node_at(&after, 3)).top));
}

#[test]
fn a_box_that_grew_pushes_its_neighbor_aside_as_little_as_needed() {
    let request = request(3, &[(0, 1), (0, 2)]);
    let before = layout(&request);
    let mut renamed = request.clone();
    renamed.nodes[1].height += 2.0 * (node_at(&before, 2).y - node_at(&before, 1).y).abs();
    let after = adjust(&before, &renamed, &nobody());
    assert_sound(&after, &renamed);
    assert!(overlapping(&after).is_empty());
    assert_eq!((node_at(&after, 0), node_at(&after, 1).y), (node_at(&before, 0), node_at(&before, 1).y));
    let gap = (rect(node_at(&after, 2)).top - rect(node_at(&after, 1)).bottom)
        .max(rect(node_at(&after, 2)).left - rect(node_at(&after, 1)).right);
    assert!((0.0..30.0).contains(&gap), "{gap}");
}

#[test]
fn a_box_that_grew_makes_way_for_one_that_is_held() {
    let request = request(3, &[(0, 1), (0, 2)]);
    let before = layout(&request);
    let mut renamed = request.clone();
    renamed.nodes[1].height += 2.0 * (node_at(&before, 2).y - node_at(&before, 1).y).abs();
    let NodeBox { x, y, .. } = *node_at(&before, 2);
    let after = adjust(&before, &renamed, &held([(2, x, y)]));
    assert_eq!((node_at(&after, 2).x, node_at(&after, 2).y), (x, y));
    assert!(overlapping(&after).is_empty());
}

#[test]
fn many_boxes_that_grow_end_up_apart() {
    let edges: Vec<(u32, u32)> = (1..30).map(|at| (at / 3, at)).collect();
    let request = request(30, &edges);
    let mut renamed = request.clone();
    renamed.nodes.iter_mut().for_each(|node| node.height += 44.0);
    renamed.nodes.iter_mut().for_each(|node| node.width += 90.0);
    let after = adjust(&layout(&request), &renamed, &nobody());
    assert_sound(&after, &renamed);
    assert!(overlapping(&after).is_empty());
}

#[test]
fn places_that_are_no_places_are_taken_as_none() {
    let request = request(2, &[(0, 1)]);
    let before = layout(&request);
    let nowhere = held([(0, f64::NAN, 3.0), (1, 4.0, f64::INFINITY), (7, 1.0, 1.0)]);
    assert_eq!(adjust(&before, &request, &nowhere), before);
    let far = adjust(&before, &request, &held([(0, 1e300, -1e300)]));
    assert_eq!((node_at(&far, 0).x, node_at(&far, 0).y), (1e6, -1e6));
    assert_sound(&far, &request);
}

#[test]
fn a_layout_that_is_unsound_is_made_sound() {
    let request = request(3, &[(0, 1), (1, 2), (2, 2)]);
    let mut before = layout(&request);
    before.nodes[1].x = f64::NAN;
    before.edges[0].path.clear();
    before.edges[2].label = Point::new(f64::INFINITY, 0.0);
    let after = adjust(&before, &request, &nobody());
    assert_sound(&after, &request);
}

#[test]
fn from_top_to_bottom_everything_is_the_same_with_the_axes_swapped() {
    let mut request = request(4, &[(0, 1), (1, 2), (2, 1), (1, 1)]);
    let places = held([(1, 40.0, 300.0), (3, -20.0, 10.0)]);
    let across = adjust(&layout(&request), &request, &places);
    for node in &mut request.nodes {
        std::mem::swap(&mut node.width, &mut node.height);
    }
    for edge in &mut request.edges {
        std::mem::swap(&mut edge.label_width, &mut edge.label_height);
    }
    request.direction = Direction::TopToBottom;
    let places = places.into_iter().map(|(id, at)| (id, Point::new(at.y, at.x))).collect();
    let down = adjust(&layout(&request), &request, &places);
    let swapped = |node: &NodeBox| (node.y, node.x, node.height, node.width);
    let plain = |node: &NodeBox| (node.x, node.y, node.width, node.height);
    assert!(down.nodes.iter().map(swapped).eq(across.nodes.iter().map(plain)));
    assert_eq!((down.left, down.top), (across.top, across.left));
}

#[test]
fn a_layout_survives_being_sent_as_json() {
    let request = request(4, &[(0, 1), (1, 2), (2, 1), (1, 1)]);
    let before = adjust(&layout(&request), &request, &held([(1, 1.0 / 3.0, -0.1)]));
    let sent = serde_json::to_string(&before).unwrap();
    assert_eq!(serde_json::from_str::<Layout>(&sent).unwrap(), before);
}
