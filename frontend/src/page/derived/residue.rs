//! What a view without rare transitions leaves out. It is only a view: nothing is taken from the specification.

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::pdfa::{Probabilities, StateId, Symbol};
use goalgraph::specification::Specification;

/// What is hidden, and how much that is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Residue {
    /// Transitions that are not drawn.
    pub(crate) transitions: BTreeSet<(StateId, Symbol)>,
    /// States that no drawn transition reaches.
    pub(crate) states: BTreeSet<StateId>,
    /// For each drawn state how many of its transitions are hidden, and their probability.
    pub(crate) at: BTreeMap<StateId, (usize, f64)>,
    /// How many demonstrations take drawn transitions only.
    pub(crate) covered: usize,
    /// How many demonstrations there are.
    pub(crate) demonstrations: usize,
}

impl Residue {
    /// Hides what is less probable than `below`, except that every state which stays in view keeps its most probable way
    /// out, so that what is shown still leads to an end.
    pub(super) fn of(specification: &Specification, probabilities: &Probabilities, below: f64) -> Self {
        if below <= 0.0 {
            return Self::default();
        }
        let pdfa = &specification.pdfa;
        let mut residue = Self { demonstrations: specification.demonstrations.len(), ..Self::default() };
        let (mut seen, mut open) = (BTreeSet::from([pdfa.initial]), vec![pdfa.initial]);
        while let Some(source) = open.pop() {
            let Some(state) = pdfa.states.get(&source) else { continue };
            let chance = |symbol: &Symbol| probabilities.transition(source, *symbol);
            let best = state
                .transitions
                .keys()
                .copied()
                .max_by(|a, b| chance(a).total_cmp(&chance(b)).then(b.cmp(a)));
            for (&symbol, way) in &state.transitions {
                let probability = chance(&symbol);
                if probability >= below || best == Some(symbol) {
                    if seen.insert(way.target) {
                        open.push(way.target);
                    }
                } else {
                    let hidden = residue.at.entry(source).or_insert((0, 0.0));
                    *hidden = (hidden.0 + 1, hidden.1 + probability);
                    residue.transitions.insert((source, symbol));
                }
            }
        }
        residue.states = pdfa.states.keys().copied().filter(|id| !seen.contains(id)).collect();
        let unseen = pdfa.transitions().filter(|(source, _, _)| residue.states.contains(source));
        residue.transitions.extend(unseen.map(|(source, symbol, _)| (source, symbol)));
        let shown = |word: &&Vec<Symbol>| {
            let ways = super::ways(pdfa, word);
            ways.len() == word.len() && ways.iter().all(|way| !residue.transitions.contains(way))
        };
        residue.covered = specification.demonstrations.iter().map(|it| &it.word).filter(shown).count();
        residue
    }
}

#[cfg(test)]
mod tests {
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;

    use super::*;

    fn residue(words: &[&str], below: f64) -> (Specification, Residue) {
        let word = |word: &&str| word.chars().map(String::from).collect();
        let words: Vec<Vec<String>> = words.iter().map(word).collect();
        let specification = infer_words("", Semantics::default(), &words);
        let probabilities = specification.pdfa.probabilities(specification.semantics);
        let residue = Residue::of(&specification, &probabilities, below);
        (specification, residue)
    }

    #[test]
    fn what_is_shown_and_what_is_hidden_sum_to_one_at_every_state() {
        let (specification, residue) = residue(&["ab", "ab", "ab", "ba", "c"], 0.25);
        assert_eq!((residue.covered, residue.demonstrations), (3, 5));
        let probabilities = specification.pdfa.probabilities(specification.semantics);
        for (&id, state) in &specification.pdfa.states {
            let shown = |symbol: &&Symbol| !residue.transitions.contains(&(id, **symbol));
            let shown: f64 = state
                .transitions
                .keys()
                .filter(shown)
                .map(|&symbol| probabilities.transition(id, symbol))
                .sum();
            let hidden = residue.at.get(&id).map_or(0.0, |(_, hidden)| *hidden);
            let whole = shown + hidden + probabilities.end(id);
            assert!(residue.states.contains(&id) || (whole - 1.0).abs() < 1e-12, "{id}: {whole}");
        }
    }

    #[test]
    fn the_most_probable_way_is_never_hidden() {
        let (_, residue) = residue(&["a", "b", "c"], 0.9);
        assert_eq!(residue.transitions.len(), 2);
        assert_eq!(residue.at[&StateId(0)].0, 2);
    }

    #[test]
    fn nothing_is_hidden_below_zero() {
        assert_eq!(residue(&["a", "b"], 0.0).1, Residue::default());
    }
}
