//! The whole pipeline on a recording that is written here: file in, specification out.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::fmt::Write;

use goalgraph::import::{Header, import};
use goalgraph::infer::{InferRequest, Inference, Method, RadiusRule, infer};
use goalgraph::specification::Specification;
use goalgraph::subset::{Setting, SubsetRequest, propose_subsets};

/// Two blocks on a table, in metres: each waits on the left until it is carried to its place on the right.
/// `red_first` tells which goes first.
fn take(number: usize, red_first: bool) -> String {
    let (mut red, mut blue) = ([0.0, 0.0], [0.0, 0.3]);
    let mut table = String::new();
    let mut frame = 0_u32;
    let mut write = |red: [f64; 2], blue: [f64; 2]| {
        frame += 1;
        // A tenth of a millimetre of wobble.
        let wobble = f64::from(frame * 7 % 5) * 5e-5 - 1e-4;
        let cells = [red[0] + wobble, red[1] - wobble, blue[0] - wobble, blue[1] + wobble];
        writeln!(table, "{number},{:.5},{:.5},{:.5},{:.5}", cells[0], cells[1], cells[2], cells[3]).unwrap();
    };
    let start = 0.01 * number as f64;
    red[0] += start;
    blue[0] -= start;
    let wait = |write: &mut dyn FnMut([f64; 2], [f64; 2]), red, blue| (0..20).for_each(|_| write(red, blue));
    wait(&mut write, red, blue);
    for is_red in [red_first, !red_first] {
        let moved = if is_red { &mut red } else { &mut blue };
        let way = [0.5 - moved[0], 0.1 - moved[1] / 3.0];
        let from = *moved;
        for step in 1..=10 {
            let share = f64::from(step) / 10.0;
            let at = [from[0] + share * way[0], from[1] + share * way[1]];
            *if is_red { &mut red } else { &mut blue } = at;
            write(red, blue);
        }
        wait(&mut write, red, blue);
    }
    table
}

/// Three takes, two of them with red first.
fn recording() -> String {
    let takes = [(0, true), (1, true), (2, false)].map(|(number, red_first)| take(number, red_first));
    format!("demo,red.x,red.y,blue.x,blue.y\n{}", takes.concat())
}

fn run(request: &InferRequest) -> Inference {
    let demonstrations = import("two blocks.csv", recording().as_bytes(), Header::Detect).unwrap();
    infer(&demonstrations, request, &mut |_| {}).unwrap()
}

fn by_default() -> InferRequest {
    InferRequest { name: "Two blocks".to_owned(), ..InferRequest::default() }
}

/// The published method with parameters that suit the recording.
fn as_published() -> InferRequest {
    let demonstrations = import("two blocks.csv", recording().as_bytes(), Header::Detect).unwrap();
    let fixed = |subset: SubsetRequest| SubsetRequest {
        epsilon: Setting::Fixed(0.001),
        min_points: Setting::Fixed(10),
        ..subset
    };
    let subsets = propose_subsets(demonstrations[0].features()).into_iter().map(fixed).collect();
    let (method, radius) = (Method::Published, RadiusRule::Largest);
    InferRequest { subsets, method, radius, ..by_default() }
}

#[test]
fn a_recording_becomes_a_specification() {
    let inference = run(&by_default());
    assert_eq!(inference.notes, [""; 0]);
    assert_eq!(inference.specification.check(), []);
    insta::assert_snapshot!(inference.specification.to_json());
}

#[test]
fn a_recording_becomes_a_specification_by_the_published_method() {
    let inference = run(&as_published());
    assert_eq!(inference.specification.check(), []);
    insta::assert_snapshot!(inference.specification.to_json());
}

#[test]
fn the_same_recording_gives_the_same_bytes() {
    for request in [by_default(), as_published()] {
        let text = run(&request).specification.to_json();
        assert_eq!(run(&request).specification.to_json(), text);
        assert_eq!(Specification::from_json(&text).unwrap().to_json(), text);
    }
}
