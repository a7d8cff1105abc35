use super::*;

fn left_to_right(nodes: u32, edges: &[(u32, u32)]) -> Layout {
    checked(&request(nodes, edges, Direction::LeftToRight))
}

fn labels_overlap(layout: &Layout) -> bool {
    let label = |edge: &EdgePath| Rect::centered(edge.label, 52.0, 28.0);
    let pairs = layout.edges.iter().enumerate();
    pairs
        .clone()
        .any(|(at, edge)| layout.edges[at + 1..].iter().any(|other| label(edge).overlap(&label(other)) > 0.0))
}

fn labels_cover_boxes(layout: &Layout) -> bool {
    let label = |edge: &EdgePath| Rect::centered(edge.label, 52.0, 28.0);
    layout.edges.iter().any(|edge| layout.nodes.iter().any(|node| label(edge).overlap(&rect(node)) > 0.0))
}

#[test]
fn nothing_gives_an_empty_drawing() {
    let layout = left_to_right(0, &[]);
    assert!(layout.nodes.is_empty() && layout.edges.is_empty() && layout.start.is_none());
}

#[test]
fn a_single_state_has_a_start_arrow() {
    let layout = left_to_right(1, &[]);
    let start = layout.start.unwrap();
    assert!(is_on_border(start.arrow.tip, &rect(&layout.nodes[0])));
    assert_within(start.from, &layout);
}

#[test]
fn a_chain_runs_straight_to_the_right() {
    let layout = left_to_right(4, &[(0, 1), (1, 2), (2, 3)]);
    assert!(
        layout.nodes.windows(2).all(|pair| pair[0].x < pair[1].x && (pair[0].y - pair[1].y).abs() < 1e-9)
    );
    assert!(layout.edges.iter().all(|edge| (edge.path[0].start.y - edge.arrow.tip.y).abs() < 1e-9));
}

#[test]
fn from_top_to_bottom_the_axes_are_swapped() {
    let layout = checked(&request(3, &[(0, 1), (1, 2), (2, 2)], Direction::TopToBottom));
    assert!(
        layout.nodes.windows(2).all(|pair| pair[0].y < pair[1].y && (pair[0].x - pair[1].x).abs() < 1e-9)
    );
}

#[test]
fn self_loops_have_labels_apart() {
    let layout = left_to_right(2, &[(0, 1), (1, 1), (1, 1), (1, 1), (0, 0)]);
    assert!(!labels_overlap(&layout) && !labels_cover_boxes(&layout));
}

#[test]
fn parallel_edges_have_labels_apart() {
    let layout = left_to_right(2, &[(0, 1), (0, 1), (0, 1), (1, 0)]);
    assert!(!labels_overlap(&layout) && !labels_cover_boxes(&layout));
}

#[test]
fn of_a_two_cycle_one_edge_points_back() {
    let layout = left_to_right(2, &[(0, 1), (1, 0)]);
    let directions: Vec<f64> = layout.edges.iter().map(|edge| edge.arrow.direction.x).collect();
    assert_eq!(directions, [1.0, -1.0]);
}

#[test]
fn disconnected_states_stand_below_those_of_the_initial_state() {
    let layout = left_to_right(5, &[(0, 1), (3, 4)]);
    let lowest = rect(&layout.nodes[0]).bottom.max(rect(&layout.nodes[1]).bottom);
    assert!(layout.nodes[2..].iter().all(|node| rect(node).top > lowest));
}

#[test]
fn an_edge_that_skips_ranks_goes_around_what_is_between() {
    let layout = left_to_right(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]);
    let points =
        layout.edges[3].path.iter().flat_map(|curve| (0..=20).map(|step| curve.at(f64::from(step) / 20.0)));
    let between = [rect(&layout.nodes[1]), rect(&layout.nodes[2])];
    assert!(points.into_iter().all(|point| !between.iter().any(|node| node.contains(point))));
}

#[test]
fn four_sub_goals_in_any_order_have_all_labels_apart() {
    let layout = checked(&lattice(4));
    assert_eq!(layout.nodes.len(), 16);
    assert!(!labels_overlap(&layout) && !labels_cover_boxes(&layout));
}

#[test]
fn two_hundred_states_are_laid_out() {
    let chain = (0..199).map(|at| (at, at + 1));
    let jumps = (0..100).map(|at| (at, at * 7 % 200));
    let back = (0..40).map(|at| (at * 5, at * 3));
    left_to_right(200, &chain.chain(jumps).chain(back).collect::<Vec<_>>());
    checked(&lattice(7));
}

#[test]
fn unsound_requests_are_made_sound() {
    let mut request = request(2, &[(0, 1), (0, 9), (8, 1)], Direction::LeftToRight);
    request.nodes.push(node(1));
    request.nodes[0].width = f64::NAN;
    request.nodes[1].height = -5.0;
    request.edges[0].label_width = f64::INFINITY;
    let layout = layout(&request);
    assert_eq!((layout.nodes.len(), layout.edges.len()), (2, 1));
    assert!(layout.width.is_finite() && layout.height.is_finite());
}

#[test]
fn edges_that_would_take_too_many_bends_run_straight() {
    let chain = (0..299).map(|at| (at, at + 1));
    let jumps = (0..150).map(|at| (at, 299));
    checked(&request(300, &chain.chain(jumps).collect::<Vec<_>>(), Direction::LeftToRight));
}

#[test]
fn twelve_sub_goals_in_any_order_are_laid_out() {
    let layout = layout(&lattice(12));
    assert_eq!((layout.nodes.len(), layout.edges.len()), (4_096, 24_576));
    assert!(layout.edges.iter().all(|edge| edge.arrow.direction.x > 0.0));
    // Thirteen columns of at most 924 states.
    assert!(layout.width < 8_000.0 && layout.height < 924.0 * 200.0, "{} x {}", layout.width, layout.height);
}
