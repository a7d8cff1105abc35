//! Words of real people, and Algorithm 1 against the sentences that describe it.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use goalgraph::demonstration::{Demonstration, Feature};
use goalgraph::import::import_words;
use goalgraph::infer::{infer_words, read_words};
use goalgraph::pdfa::{Pdfa, Semantics, StateId, Symbol, Word};
use goalgraph::specification::{Ball, Specification, SubGoal, SubsetParameters};
use proptest::prelude::*;

/// How many words the automaton, which has no cycles, accepts.
fn accepted_words(pdfa: &Pdfa, from: StateId, known: &mut BTreeMap<StateId, u64>) -> u64 {
    if let Some(&count) = known.get(&from) {
        return count;
    }
    let state = &pdfa.states[&from];
    let onward: u64 = state.transitions.values().map(|way| accepted_words(pdfa, way.target, known)).sum();
    let count = onward + u64::from(state.accepting);
    known.insert(from, count);
    count
}

/// A file of words gives these numbers of words, distinct words, states, transitions, accepting states and accepted words.
#[track_caller]
fn check(path: &str, expected: [usize; 6]) -> Specification {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/");
    let file = import_words(&std::fs::read(format!("{folder}{path}")).unwrap()).unwrap();
    let specification = infer_words(path, Semantics::MaximumLikelihood, file.clone());
    let words = &file.words;
    let pdfa = &specification.pdfa;
    let found = [
        words.len(),
        words.iter().collect::<BTreeSet<_>>().len(),
        pdfa.states.len(),
        pdfa.transitions().count(),
        pdfa.states.values().filter(|state| state.accepting).count(),
        accepted_words(pdfa, pdfa.initial, &mut BTreeMap::new()) as usize,
    ];
    assert_eq!(found, expected, "{path}");
    assert_eq!(specification.check(), []);
    specification
}

#[test]
fn nineteen_people_put_an_assembly_together_in_eleven_orders() {
    let specification = check("assembly-words/words.txt", [19, 11, 27, 37, 1, 17]);
    let names: Vec<&str> = specification.sub_goals.iter().map(|sub_goal| sub_goal.name.as_str()).collect();
    assert_eq!(names, ["a0", "a3", "a5", "a1", "a4", "a2"]);
    assert!(specification.sub_goals.iter().all(|sub_goal| sub_goal.demonstrations == 19));
}

#[test]
fn people_build_towers_of_blocks() {
    check("tower-words/blocks_004_top.txt", [10, 10, 31, 46, 1, 156]);
    check("tower-words/blocks_005_top.txt", [35, 9, 17, 23, 1, 28]);
    check("tower-words/blocks_006_top.txt", [7, 5, 28, 32, 1, 12]);
    check("tower-words/blocks_008_top.txt", [14, 11, 24, 31, 1, 36]);
}

/// The features of two subsets: a line and a plane.
const FEATURES: [&str; 3] = ["line", "plane.x", "plane.y"];

/// A sub-goal of the line or the plane: center and radius.
type Place = (bool, [f64; 2], f64);

fn specification(places: &[Place]) -> Specification {
    let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
    let subset = |name: &str, features: &[&str]| SubsetParameters {
        name: name.to_owned(),
        features: names(features),
        epsilon: 1.0,
        min_points: 1,
        min_dwell: 1,
    };
    let subsets = vec![subset("line", &FEATURES[..1]), subset("plane", &FEATURES[1..])];
    let sub_goal = |(index, &(in_plane, center, radius)): (usize, &Place)| {
        let subset = &subsets[usize::from(in_plane)];
        let center = center[..subset.features.len()].to_vec();
        let ball = Ball { subset: subset.name.clone(), features: subset.features.clone(), center, radius };
        let name = format!("place {index}");
        SubGoal {
            id: Symbol(index as u32),
            name,
            ball: Some(ball),
            frames: 0,
            demonstrations: 0,
            color: None,
        }
    };
    Specification {
        name: String::new(),
        semantics: Semantics::default(),
        features: FEATURES.map(Feature::new).to_vec(),
        sub_goals: places.iter().enumerate().map(sub_goal).collect(),
        subsets,
        pdfa: Pdfa::from_words(&[]),
        demonstrations: Vec::new(),
    }
}

/// Algorithm 1, sentence by sentence.
fn algorithm_1(places: &[Place], frames: &[[f64; 3]]) -> Word {
    let mut word = Word::new();
    // For every frame in order:
    for &[line, x, y] in frames {
        // the first sub-goal in alphabet order
        for (index, &(in_plane, center, radius)) in places.iter().enumerate() {
            let symbol = Symbol(index as u32);
            // whose ball holds the frame's partial state (an undefined feature satisfies nothing)
            let holds = if in_plane {
                !x.is_nan() && !y.is_nan() && (x - center[0]).hypot(y - center[1]) <= radius
            } else {
                !line.is_nan() && (line - center[0]).abs() <= radius
            };
            // and that is not yet in the word is appended; at most one symbol per frame.
            if holds && !word.contains(&symbol) {
                word.push(symbol);
                break;
            }
        }
    }
    word
}

/// Coordinates on a grid, so that points lie on the surfaces of balls, too.
fn coordinate() -> impl Strategy<Value = f64> {
    (-4..=4_i32).prop_map(f64::from)
}

proptest! {
    #[test]
    fn words_are_read_as_algorithm_1_says(
        places in prop::collection::vec(
            (any::<bool>(), [coordinate(), coordinate()], (0..4_i32).prop_map(f64::from)), 0..7),
        frames in prop::collection::vec(
            prop::array::uniform3(prop_oneof![4 => coordinate(), 1 => Just(f64::NAN)]), 1..20),
    ) {
        let features: Arc<[Feature]> = FEATURES.map(Feature::new).into();
        let demonstration = Demonstration::new("d", "", features, frames.concat()).unwrap();
        let found = read_words(&specification(&places), &[demonstration]);
        prop_assert_eq!(found, [algorithm_1(&places, &frames)]);
    }
}

#[test]
fn one_frame_gives_one_symbol_and_a_symbol_comes_once() {
    let places = [(false, [0.0, 0.0], 1.0), (true, [0.0, 0.0], 1.0), (false, [0.0, 0.0], 2.0)];
    let read = |frames: &[[f64; 3]]| {
        let features: Arc<[Feature]> = FEATURES.map(Feature::new).into();
        let demonstration = Demonstration::new("d", "", features, frames.concat()).unwrap();
        let word = read_words(&specification(&places), &[demonstration]).remove(0);
        word.iter().map(|symbol| symbol.0).collect::<Vec<_>>()
    };
    assert_eq!(read(&[[0.0; 3]]), [0]);
    assert_eq!(read(&[[0.0; 3]; 9]), [0, 1, 2]);
    assert_eq!(read(&[[2.0, 9.0, 9.0], [1.0, 9.0, 9.0]]), [2, 0]);
    assert_eq!(read(&[[f64::NAN, 0.0, f64::NAN], [f64::NAN, 0.0, 1.0]]), [1]);
    assert_eq!(read(&[[f64::NAN; 3]]), [0; 0]);
}
