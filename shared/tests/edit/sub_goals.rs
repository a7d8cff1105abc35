//! Making sub-goals one and removing them: words and automaton are read again.

use goalgraph::edit::{Edit, Outcome};
use goalgraph::pdfa::{Pdfa, Symbol, Word};
use proptest::prelude::*;

use crate::generate::{above, cases, learned as learned_words, words};
use crate::{A, B, C, D, edited, language, learned, q, refused, word};

fn merge(kept: Symbol, merged: Symbol) -> Edit {
    Edit::MergeSubGoals { kept, merged, first_new: q(20) }
}

fn remove(symbol: Symbol) -> Edit {
    Edit::RemoveSubGoal { symbol, first_new: q(20) }
}

#[test]
fn only_the_first_of_what_is_one_now_stays_in_a_word() {
    let before = learned(&["abc", "bac", "cb"]);
    let (after, _) = edited(&before, &merge(A, B));
    let words: Vec<&Word> = after.demonstrations.iter().map(|shown| &shown.word).collect();
    assert_eq!(words, [&word("ac"), &word("ac"), &word("ca")]);
    assert_eq!(language(&after, 3), ["ac", "ca"]);
    let stays = after.sub_goal(A).unwrap();
    let ball = stays.ball.as_ref().unwrap();
    assert_eq!((ball.center[0], ball.radius), (0.5, 0.75), "the smallest ball around both");
    assert_eq!((stays.frames, stays.demonstrations), (14, 3));
    assert!(after.sub_goal(B).is_none());
}

#[test]
fn states_are_recognized_by_what_is_completed() {
    // q0 -a-> q1 -b-> q2 -c-> q3, q0 -b-> q4 -a-> q2
    let mut before = learned(&["abc", "bac"]);
    before.pdfa.states.get_mut(&q(3)).unwrap().name = Some("done".to_owned());
    let (after, change) = edited(&before, &merge(A, B));
    assert_eq!(after.pdfa.states.keys().copied().collect::<Vec<_>>(), [q(0), q(1), q(3)]);
    assert_eq!(change.folded, [(q(2), q(1)), (q(4), q(1))].into());
    assert_eq!(after.pdfa.states[&q(3)].name.as_deref(), Some("done"));
    assert!(change.added.is_empty() && change.removed.is_empty());
}

#[test]
fn states_for_sets_that_there_were_not_get_new_ids() {
    let before = learned(&["abc"]);
    let (merged, _) = edited(&before, &Edit::MergeStates { kept: q(0), merged: q(1) });
    let (after, change) = edited(&merged, &remove(C));
    assert_eq!(change.added, [q(20)].into());
    assert_eq!(after.pdfa.transition(q(0), A).unwrap().target, q(20));
    assert_eq!(after.pdfa.transition(q(20), B).unwrap().target, q(2));
}

#[test]
fn weights_that_an_expert_changed_stay_where_the_way_is_the_same() {
    let before = learned(&["ab", "ab", "b", "cb"]);
    let reweight =
        Edit::Reweight { state: q(0), outcome: Outcome::Transition(A), probability: 0.9, locked: [].into() };
    let (before, _) = edited(&before, &reweight);
    let (before, _) = edited(&before, &Edit::SetAccepting { state: q(1), accepting: true });
    let (after, _) = edited(&before, &remove(C));
    let weight = |symbol| after.pdfa.transition(q(0), symbol).unwrap().weight;
    assert!((weight(A) - 3.6).abs() < 1e-12 && (weight(B) - 0.2).abs() < 1e-12);
    assert_eq!(after.pdfa.transition(q(0), B).unwrap().count, 2, "b and c b are one word now");
    assert!(after.pdfa.states[&q(1)].accepting);
}

#[test]
fn what_cannot_be_one_is_refused() {
    let before = learned(&["abcd"]);
    refused(&before, &merge(A, C), "g0 and g2 are places of different features and cannot be merged");
    refused(&before, &merge(A, A), "g0 cannot be merged into itself");
    refused(&before, &merge(A, Symbol(9)), "g9: there is no such sub-goal");
    refused(&before, &merge(Symbol(9), A), "g9: there is no such sub-goal");
    refused(&before, &remove(Symbol(9)), "g9: there is no such sub-goal");
    let taken = Edit::RemoveSubGoal { symbol: D, first_new: q(3) };
    refused(&before, &taken, "q3: a new state needs an id above q4, because ids are never reused");
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn the_automaton_is_that_of_the_new_words(words in words(), gone in 0..4_u32, together in any::<bool>()) {
        let before = learned_words(&words);
        let gone = Symbol(gone);
        // Places of one subset: g0 with g1, g2 with g3.
        let kept = Symbol(gone.0 ^ 1);
        let first_new = above(&before);
        let edit = if together {
            Edit::MergeSubGoals { kept, merged: gone, first_new }
        } else {
            Edit::RemoveSubGoal { symbol: gone, first_new }
        };
        let (after, change) = edited(&before, &edit);
        let reread = words.iter().map(|word| {
            let mut new = Word::new();
            for &symbol in word {
                let symbol = if symbol == gone { kept } else { symbol };
                let drop = if together { symbol == kept && new.contains(&kept) } else { false };
                new.extend((!drop).then_some(symbol));
            }
            if together { new } else { word.iter().copied().filter(|&symbol| symbol != gone).collect() }
        });
        let reread: Vec<Word> = reread.collect();
        prop_assert_eq!(&after.demonstrations.iter().map(|shown| shown.word.clone()).collect::<Vec<_>>(), &reread);
        let expected = Pdfa::from_words(&reread);
        prop_assert_eq!(after.pdfa.states.len(), expected.states.len());
        for (id, state) in &after.pdfa.states {
            let same = expected.states.values().find(|other| other.completed == state.completed).unwrap();
            prop_assert_eq!((same.end_count, same.accepting), (state.end_count, state.accepting));
            prop_assert!(before.pdfa.states.contains_key(id), "each set was there before: {id}");
            for (symbol, way) in &same.transitions {
                let found = &state.transitions[symbol];
                prop_assert_eq!((way.count, way.weight), (found.count, found.weight));
                let (to, found) = (&expected.states[&way.target], &after.pdfa.states[&found.target]);
                prop_assert_eq!(&to.completed, &found.completed);
            }
        }
        prop_assert!(change.added.is_empty());
    }
}

#[test]
fn without_demonstrations_only_what_no_transition_uses_can_go() {
    let mut drawn = learned(&["ab", "c"]);
    drawn.demonstrations.clear();
    let why = "there are no demonstrations from which the automaton could be read again without it";
    refused(&drawn, &remove(A), &format!("g0: {why}"));
    refused(&drawn, &merge(A, B), &format!("g1: {why}"));
    for way in drawn.pdfa.states.values_mut() {
        way.transitions.remove(&C);
    }
    let (after, _) = edited(&drawn, &remove(C));
    assert!(after.sub_goal(C).is_none());
    assert!(after.pdfa.states.values().all(|state| !state.completed.contains(&C)));
    assert_eq!(after.pdfa.transitions().count(), 2);
}

#[test]
fn removing_a_sub_goal_that_nothing_uses_keeps_every_other_correction() {
    let before = learned(&["abc", "bac"]);
    let (mut corrected, _) = edited(&before, &Edit::MergeStates { kept: q(1), merged: q(4) });
    let states = corrected.pdfa.clone();
    let mut unused = corrected.sub_goals[0].clone();
    unused.id = Symbol(9);
    corrected.sub_goals.push(unused);
    let (after, _) = edited(&corrected, &remove(Symbol(9)));
    assert_eq!(after.pdfa, states);
}
