//! Conformance: whether an automaton accepts a word, and where it does not.

use crate::pdfa::{Pdfa, Probabilities, StateId, Symbol};

/// How a word fares in an automaton.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conformance {
    /// It is accepted with this natural logarithm of its probability.
    Accepted {
        /// At most zero.
        log_likelihood: f64,
    },
    /// There is no way on.
    Deviates {
        /// Position in the word of the first symbol without a way, from 0.
        position: usize,
        /// The state without the way.
        state: StateId,
    },
    /// It ends where the task does not.
    EndsEarly {
        /// The state that is not accepting.
        state: StateId,
    },
}

/// Follows `word` from the initial state; a symbol of no sub-goal is `None`. A way of probability zero is no way.
///
/// # Complexity
///
/// O(n log T) for a word of n symbols and T transitions.
pub fn follow(pdfa: &Pdfa, probabilities: &Probabilities, word: &[Option<Symbol>]) -> Conformance {
    let mut state = pdfa.initial;
    let mut log_likelihood = 0.0;
    for (position, symbol) in word.iter().enumerate() {
        let way = symbol.and_then(|symbol| {
            let probability = probabilities.transition(state, symbol);
            pdfa.transition(state, symbol).filter(|_| probability > 0.0).map(|way| (way.target, probability))
        });
        let Some((target, probability)) = way else {
            return Conformance::Deviates { position, state };
        };
        log_likelihood += probability.ln();
        state = target;
    }
    let end = probabilities.end(state);
    if end > 0.0 {
        Conformance::Accepted { log_likelihood: log_likelihood + end.ln() }
    } else {
        Conformance::EndsEarly { state }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pdfa::Semantics;

    #[test]
    fn a_word_is_accepted_deviates_or_ends_early() {
        let (a, b) = (Symbol(0), Symbol(1));
        let pdfa = Pdfa::from_words(&[vec![a, b], vec![b, a]]);
        let probabilities = pdfa.probabilities(Semantics::MaximumLikelihood);
        let check = |word: &[Option<Symbol>], expected| {
            assert_eq!(follow(&pdfa, &probabilities, word), expected);
        };
        check(&[Some(a), Some(b)], Conformance::Accepted { log_likelihood: 0.5_f64.ln() });
        check(&[Some(a), Some(a)], Conformance::Deviates { position: 1, state: StateId(1) });
        check(&[None], Conformance::Deviates { position: 0, state: StateId(0) });
        check(&[Some(a)], Conformance::EndsEarly { state: StateId(1) });
        check(&[], Conformance::EndsEarly { state: StateId(0) });
    }
}
