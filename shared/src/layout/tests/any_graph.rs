use proptest::prelude::*;

use super::*;

fn any_request() -> impl Strategy<Value = LayoutRequest> {
    let direction = prop_oneof![Just(Direction::LeftToRight), Just(Direction::TopToBottom)];
    let graph = (1_u32..28).prop_flat_map(|count| {
        let edges = proptest::collection::vec((0..count, 0..count), 0..60);
        (Just(count), edges, 0..count)
    });
    (graph, direction).prop_map(|((count, edges, initial), direction)| {
        let mut request = request(count, &edges, direction);
        request.initial = StateId(initial);
        request
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(160))]

    #[test]
    fn any_graph_is_laid_out(request in any_request()) {
        let layout = checked(&request);
        prop_assert!(layout.start.is_some());
    }

    #[test]
    fn edges_meet_no_other_box(request in any_request()) {
        let layout = layout(&request);
        for edge in &layout.edges {
            let others = layout.nodes.iter().filter(|node| node.id != edge.source && node.id != edge.target);
            for other in others {
                let inside = |point: Point| rect(other).grown(-0.5).contains(point);
                let points = edge.path.iter().flat_map(|curve| (0..=10).map(|step| curve.at(f64::from(step) / 10.0)));
                prop_assert!(!points.into_iter().any(inside), "{edge:?} meets {other:?}");
            }
        }
    }
}
