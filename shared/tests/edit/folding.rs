//! Merging states, against the finest deterministic partition found by brute force.

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::edit::Edit;
use goalgraph::pdfa::{Pdfa, StateId, Symbol};
use goalgraph::specification::Specification;
use proptest::prelude::*;

use crate::generate::{any_specification, assert_sound, cases};
use crate::{A, B, edited, language, learned, q, refused};

/// The finest partition with both in one block in which equal symbols lead from one block to one block: pairs are added
/// until nothing changes.
fn blocks(pdfa: &Pdfa, kept: StateId, merged: StateId) -> BTreeMap<StateId, BTreeSet<StateId>> {
    let mut block: BTreeMap<StateId, BTreeSet<StateId>> =
        pdfa.states.keys().map(|&id| (id, BTreeSet::from([id]))).collect();
    let mut pairs = vec![(kept, merged)];
    while let Some((one, other)) = pairs.pop() {
        if !block[&one].contains(&other) {
            let union: BTreeSet<StateId> = &block[&one] | &block[&other];
            for id in &union {
                block.insert(*id, union.clone());
            }
        }
        for (&one, together) in &block {
            for &other in together {
                for (symbol, way) in &pdfa.states[&one].transitions {
                    let target = pdfa.states[&other].transitions.get(symbol);
                    pairs.extend(
                        target.map(|t| (way.target, t.target)).filter(|(a, b)| !block[a].contains(b)),
                    );
                }
            }
        }
    }
    block
}

/// Determinizes the quotient of the automaton by its blocks: the sets of blocks that words lead to.
fn subsets(
    pdfa: &Pdfa,
    block: &BTreeMap<StateId, BTreeSet<StateId>>,
) -> BTreeSet<BTreeSet<BTreeSet<StateId>>> {
    let mut found = BTreeSet::new();
    let mut open = vec![BTreeSet::from([block[&pdfa.initial].clone()])];
    while let Some(subset) = open.pop() {
        if !found.insert(subset.clone()) {
            continue;
        }
        let mut next: BTreeMap<Symbol, BTreeSet<BTreeSet<StateId>>> = BTreeMap::new();
        for id in subset.iter().flatten() {
            for (&symbol, way) in &pdfa.states[id].transitions {
                next.entry(symbol).or_default().insert(block[&way.target].clone());
            }
        }
        open.extend(next.into_values());
    }
    found
}

fn saturating(counts: impl Iterator<Item = u64>) -> u64 {
    counts.fold(0, u64::saturating_add)
}

proptest! {
    #![proptest_config(cases(1024))]

    #[test]
    fn merging_gives_the_finest_deterministic_partition(
        specification in any_specification(),
        kept in any::<prop::sample::Index>(),
        merged in any::<prop::sample::Index>(),
    ) {
        let before = &specification.pdfa;
        let ids: Vec<StateId> = before.states.keys().copied().collect();
        let (kept, merged) = (*kept.get(&ids), *merged.get(&ids));
        prop_assume!(kept != merged);
        let (after, change) = edited(&specification, &Edit::MergeStates { kept, merged });
        let block = blocks(before, kept, merged);
        prop_assert!(subsets(before, &block).iter().all(|subset| subset.len() == 1), "the partition is deterministic");
        let name = |id: StateId| if block[&id].contains(&kept) { kept } else { *block[&id].first().unwrap() };
        let names: BTreeSet<StateId> = before.states.keys().map(|&id| name(id)).collect();
        prop_assert_eq!(after.pdfa.states.keys().copied().collect::<BTreeSet<_>>(), names);
        prop_assert_eq!(after.pdfa.initial, name(before.initial));
        prop_assert!(change.removed.is_empty() && change.added.is_empty());
        for &id in before.states.keys() {
            prop_assert_eq!(change.folded.get(&id).copied(), (name(id) != id).then(|| name(id)));
        }
        for (id, state) in &after.pdfa.states {
            let members = || block[id].iter().map(|id| &before.states[id]);
            prop_assert_eq!(state.accepting, members().any(|state| state.accepting));
            prop_assert_eq!(state.end_count, saturating(members().map(|state| state.end_count)));
            let sets = members().map(|state| state.completed.clone());
            prop_assert_eq!(&state.completed, &sets.reduce(|one, other| &one & &other).unwrap());
            let symbols: BTreeSet<Symbol> =
                members().flat_map(|state| state.transitions.keys().copied()).collect();
            prop_assert_eq!(state.transitions.keys().copied().collect::<BTreeSet<_>>(), symbols);
            for (symbol, way) in &state.transitions {
                let ways = || members().filter_map(|state| state.transitions.get(symbol));
                prop_assert!(ways().all(|before| name(before.target) == way.target));
                prop_assert_eq!(way.count, saturating(ways().map(|way| way.count)));
                let weight: f64 = ways().map(|way| way.weight).sum();
                prop_assert!((way.weight - weight.min(1e100)).abs() <= 1e-12 * weight);
            }
        }
        prop_assert_eq!(initial_reaches_as_many(&after), subsets(before, &block).len());
    }

    #[test]
    fn what_was_accepted_stays_accepted_after_a_merge(
        words in crate::generate::simple_words(), kept in 0..9_u32, merged in 0..9_u32,
    ) {
        let before = crate::generate::learned(&words);
        let mut after = before.clone();
        if (Edit::MergeStates { kept: StateId(kept), merged: StateId(merged) }).apply(&mut after).is_ok() {
            assert_sound(&after);
            let after = language(&after, 4);
            prop_assert!(language(&before, 4).iter().all(|word| after.contains(word)));
        }
    }
}

fn initial_reaches_as_many(specification: &Specification) -> usize {
    let alone = specification.pdfa.states.keys().map(|&id| (id, BTreeSet::from([id]))).collect();
    subsets(&specification.pdfa, &alone).len()
}

#[test]
fn targets_of_equal_symbols_fold_together() {
    // q0 -a-> q1 -c-> q2 -d-> q3, q0 -b-> q4 -c-> q5
    let before = learned(&["acd", "bc"]);
    let (after, change) = edited(&before, &Edit::MergeStates { kept: q(4), merged: q(1) });
    assert_eq!(change.folded, [(q(1), q(4)), (q(5), q(2))].into());
    assert_eq!(after.pdfa.transition(q(4), crate::C).unwrap().count, 2);
    assert_eq!(language(&after, 4), ["ac", "bc", "acd", "bcd"]);
    assert!(after.pdfa.states[&q(4)].completed.is_empty(), "neither a nor b is surely completed");
}

#[test]
fn merging_along_a_way_makes_a_cycle() {
    let before = learned(&["ab"]);
    let (after, _) = edited(&before, &Edit::MergeStates { kept: q(0), merged: q(1) });
    assert_eq!(after.pdfa.transition(q(0), A).unwrap().target, q(0));
    assert_eq!(language(&after, 2), ["b", "ab"]);
}

#[test]
fn the_initial_state_may_become_part_of_another() {
    let before = learned(&["ab"]);
    let (after, change) = edited(&before, &Edit::MergeStates { kept: q(2), merged: q(0) });
    assert_eq!((after.pdfa.initial, change.folded), (q(2), [(q(0), q(2))].into()));
    assert_eq!(after.pdfa.transition(q(1), B).unwrap().target, q(2));
}

#[test]
fn the_kept_name_stays_or_else_the_other() {
    let mut before = learned(&["a", "b"]);
    let rename = |state, name: &str| Edit::RenameState { state, name: name.to_owned() };
    rename(q(2), "other").apply(&mut before).unwrap();
    let merge = Edit::MergeStates { kept: q(1), merged: q(2) };
    assert_eq!(edited(&before, &merge).0.pdfa.states[&q(1)].name.as_deref(), Some("other"));
    rename(q(1), "kept").apply(&mut before).unwrap();
    assert_eq!(edited(&before, &merge).0.pdfa.states[&q(1)].name.as_deref(), Some("kept"));
}

#[test]
fn what_cannot_be_merged_is_refused() {
    let before = learned(&["a"]);
    refused(&before, &Edit::MergeStates { kept: q(1), merged: q(1) }, "q1 cannot be merged into itself");
    refused(&before, &Edit::MergeStates { kept: q(7), merged: q(1) }, "q7: there is no such state");
    refused(&before, &Edit::MergeStates { kept: q(1), merged: q(7) }, "q7: there is no such state");
}
