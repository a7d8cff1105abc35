//! Words drawn from an automaton: what it would have demonstrated.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::language::WordDistribution;
use crate::language::chain::Chain;
use crate::pdfa::Word;

/// Draws `number` words; the same seed gives the same words on every machine.
///
/// A run that gets into a state from which nothing goes on, or that has not ended after `max_length` symbols, is no
/// word and left out: fewer words than `number` come back then, and their share estimates the probability that a run
/// ends in time. The words that come back are distributed as the words of at most `max_length` symbols are.
///
/// Each step draws 53 bits and takes the first outcome whose cumulated probability is above them: transitions in the
/// order of the alphabet, the end last.
///
/// # Complexity
///
/// O(T log T + n · l · A) for T transitions, n words of l symbols and A transitions out of a state.
///
/// # Example
///
/// ```
/// use goalgraph::language::WordDistribution;
/// use goalgraph::pdfa::{Pdfa, Symbol};
/// use goalgraph::sampling::sample_words;
///
/// let pdfa = Pdfa::from_words(&[vec![Symbol(0)], vec![Symbol(1)]]);
/// let words = sample_words(&WordDistribution::of(&pdfa), 7, 100, 10);
/// assert!(words.iter().all(|word| word.len() == 1));
/// assert_eq!(words.len(), 100);
/// ```
pub fn sample_words(
    distribution: &WordDistribution,
    seed: u64,
    number: usize,
    max_length: usize,
) -> Vec<Word> {
    let chain = Chain::new(distribution.pdfa(), distribution.probabilities());
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..number).filter_map(|_| draw(&chain, &mut random, max_length)).collect()
}

fn draw(chain: &Chain, random: &mut ChaCha8Rng, max_length: usize) -> Option<Word> {
    let mut state = chain.initial?;
    let mut word = Word::new();
    loop {
        let mut rest = uniform(random);
        let mut taken = None;
        for way in &chain.ways[state] {
            if rest < way.probability {
                taken = Some(way);
                break;
            }
            rest -= way.probability;
        }
        // Rounding may leave a little over where nothing ends: that is the last way's.
        let taken = taken.or_else(|| chain.ways[state].last().filter(|_| chain.ends[state] == 0.0));
        let Some(way) = taken else {
            return (chain.ends[state] > 0.0).then_some(word);
        };
        if word.len() == max_length {
            return None;
        }
        word.push(way.symbol);
        state = way.target;
    }
}

/// A multiple of 2^-53 from 0 to below 1.
fn uniform(random: &mut ChaCha8Rng) -> f64 {
    const STEPS: f64 = (1_u64 << 53) as f64;
    (random.next_u64() >> 11) as f64 / STEPS
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pdfa::{Pdfa, Symbol};

    fn orders() -> Vec<Word> {
        let [a, b, c] = [0, 1, 2].map(Symbol);
        vec![vec![a, b, c], vec![a, b, c], vec![a, c, b], vec![c]]
    }

    #[test]
    fn the_same_seed_gives_the_same_words() {
        let pdfa = Pdfa::from_words(&orders());
        let distribution = WordDistribution::of(&pdfa);
        let words = sample_words(&distribution, 3, 50, 9);
        assert_eq!(words, sample_words(&distribution, 3, 50, 9));
        assert_ne!(words, sample_words(&distribution, 4, 50, 9));
        let first =
            vec![vec![Symbol(0), Symbol(1), Symbol(2)], vec![Symbol(2)], vec![Symbol(2)], vec![Symbol(2)]];
        assert_eq!(sample_words(&distribution, 0, 4, 9), first, "as every machine must draw them");
    }

    #[test]
    fn words_come_as_often_as_they_are_probable() {
        let pdfa = Pdfa::from_words(&orders());
        let distribution = WordDistribution::of(&pdfa);
        let words = sample_words(&distribution, 1, 20_000, 9);
        assert_eq!(words.len(), 20_000);
        for word in orders() {
            let share = words.iter().filter(|drawn| **drawn == word).count() as f64 / 20_000.0;
            assert!((share - distribution.probability(&word)).abs() < 0.015);
        }
    }

    #[test]
    fn runs_that_do_not_end_in_time_are_left_out() {
        let mut pdfa = Pdfa::from_words(&orders());
        let all = sample_words(&WordDistribution::of(&pdfa), 1, 2_000, 2);
        assert!(all.iter().all(|word| word.len() == 1));
        assert!((400..600).contains(&all.len()));
        for state in pdfa.states.values_mut() {
            state.accepting = false;
        }
        assert_eq!(sample_words(&WordDistribution::of(&pdfa), 1, 10, 9), Vec::<Word>::new());
    }
}
