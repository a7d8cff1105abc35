use std::collections::BTreeMap;

use goalgraph::layout::{EdgePath, Layout, LayoutRequest, Point, adjust, layout};
use goalgraph::pdfa::StateId;
use proptest::prelude::*;

use super::scene::*;

/// One change of a drawing; numbers are taken modulo what there is.
#[derive(Clone, Debug)]
enum Change {
    AddNode,
    RemoveNode(usize),
    Grow(usize, f64),
    AddEdge(usize, usize),
    RemoveEdge(usize),
    Hold(usize, f64, f64),
}

fn any_change() -> impl Strategy<Value = Change> {
    prop_oneof![
        Just(Change::AddNode),
        any::<usize>().prop_map(Change::RemoveNode),
        (any::<usize>(), -20.0..60.0).prop_map(|(at, by)| Change::Grow(at, by)),
        (any::<usize>(), any::<usize>()).prop_map(|(from, to)| Change::AddEdge(from, to)),
        any::<usize>().prop_map(Change::RemoveEdge),
        (any::<usize>(), -400.0..1500.0, -400.0..900.0).prop_map(|(at, x, y)| Change::Hold(at, x, y)),
    ]
}

/// A drawing that is edited.
struct Edited {
    request: LayoutRequest,
    held: BTreeMap<StateId, Point>,
    layout: Layout,
    next_node: u32,
    next_symbol: u32,
}

impl Edited {
    fn change(&mut self, change: &Change) {
        let count = self.request.nodes.len();
        let some = |number: usize| number % count.max(1);
        match *change {
            Change::AddNode => {
                self.request.nodes.push(node(self.next_node));
                self.next_node += 1;
            }
            Change::RemoveNode(at) if count > 1 => {
                let gone = self.request.nodes.remove(some(at)).id;
                self.request.edges.retain(|edge| edge.source != gone && edge.target != gone);
                self.held.remove(&gone);
                self.request.initial = self.request.nodes[0].id;
            }
            Change::Grow(at, by) => {
                let node = &mut self.request.nodes[some(at)];
                node.width = (node.width + by).max(20.0);
                node.height = (node.height + by / 2.0).max(20.0);
            }
            Change::AddEdge(from, to) => {
                let (from, to) = (self.request.nodes[some(from)].id.0, self.request.nodes[some(to)].id.0);
                self.request.edges.push(edge(from, self.next_symbol, to));
                self.next_symbol += 1;
            }
            Change::RemoveEdge(at) if !self.request.edges.is_empty() => {
                self.request.edges.remove(at % self.request.edges.len());
            }
            Change::Hold(at, x, y) => {
                self.held.insert(self.request.nodes[some(at)].id, Point::new(x, y));
            }
            _ => {}
        }
    }
}

fn any_start() -> impl Strategy<Value = LayoutRequest> {
    (1_u32..14).prop_flat_map(|count| {
        let edges = proptest::collection::vec((0..count, 0..count), 0..24);
        edges.prop_map(move |edges| request(count, &edges))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn over_a_hundred_edits_what_nobody_touched_stays(
        start in any_start(),
        changes in proptest::collection::vec(any_change(), 100),
    ) {
        let layout = layout(&start);
        let mut edited = Edited { request: start, held: BTreeMap::new(), layout, next_node: 100, next_symbol: 100 };
        for change in &changes {
            let (old_request, old_held) = (edited.request.clone(), edited.held.clone());
            edited.change(change);
            let after = adjust(&edited.layout, &edited.request, &edited.held);
            assert_sound(&after, &edited.request);
            for (id, at) in &edited.held {
                let node = node_at(&after, id.0);
                prop_assert_eq!((node.x, node.y), (at.x, at.y));
            }
            if !matches!(change, Change::Grow(..)) {
                for node in &edited.layout.nodes {
                    let stays = edited.held.get(&node.id) == old_held.get(&node.id)
                        && edited.request.nodes.iter().any(|asked| asked.id == node.id);
                    prop_assert!(!stays || after.nodes.contains(node), "{:?} moved by {:?}", node, change);
                }
            }
            if old_request == edited.request && old_held == edited.held {
                prop_assert_eq!(&after, &edited.layout);
            }
            edited.layout = after;
        }
        let again = adjust(&edited.layout, &edited.request, &BTreeMap::new());
        prop_assert_eq!(again, edited.layout);
    }

    #[test]
    fn edges_between_states_that_stay_keep_their_path_unless_a_box_is_on_it(
        start in any_start(), at in any::<usize>(), x in -200.0..1200.0, y in -200.0..700.0,
    ) {
        let before = layout(&start);
        let moved = start.nodes[at % start.nodes.len()].id;
        let after = adjust(&before, &start, &held([(moved.0, x, y)]));
        let on = |edge: &EdgePath| {
            let near = inner(&rect(node_at(&after, moved.0)), -6.0);
            near.overlap(&label(edge)) > 0.0 || points(edge).into_iter().any(|point| near.contains(point))
        };
        for (old, new) in before.edges.iter().zip(&after.edges) {
            if old.source != moved && old.target != moved && !on(old) {
                prop_assert_eq!(old, new);
            }
        }
    }

    #[test]
    fn in_a_drawing_with_room_new_edges_and_labels_are_clear_of_boxes(
        edges in proptest::collection::vec((0_u32..9, 0_u32..9), 1..7),
    ) {
        let places = (0..9).map(|at| (StateId(at), Point::new(f64::from(at % 3) * 420.0, f64::from(at / 3) * 300.0)));
        let places: BTreeMap<StateId, Point> = places.collect();
        let before = adjust(&layout(&request(9, &[])), &request(9, &[]), &places);
        let request = request(9, &edges);
        let after = adjust(&before, &request, &places);
        assert_sound(&after, &request);
        for edge in &after.edges {
            prop_assert!(met(&after, edge).is_empty(), "{:?}", edge);
            for node in &after.nodes {
                prop_assert!(label(edge).overlap(&rect(node)) <= 0.0, "{:?} {:?}", edge, node);
            }
        }
    }
}
