//! Words without the demonstrations behind them, as many as one likes.

use crate::chance::Chance;

/// In how many orders a task is usually done, and how many neighbors change places in one word at most.
const USUAL_ORDERS: usize = 4;
const SWAPS: usize = 3;

/// `count` words, each of which holds every symbol from 0 to `alphabet` once: one of four usual orders in which up to
/// three neighbors have changed places, as different people do the same task.
pub fn shuffled_words(count: usize, alphabet: u32, seed: u64) -> Vec<Vec<u32>> {
    let mut chance = Chance::new(seed, 0);
    let orders: Vec<Vec<u32>> = (0..USUAL_ORDERS)
        .map(|_| {
            let mut order: Vec<u32> = (0..alphabet).collect();
            chance.shuffle(&mut order);
            order
        })
        .collect();
    (0..count)
        .map(|_| {
            let mut word = orders[chance.whole(0, USUAL_ORDERS - 1)].clone();
            for _ in 0..chance.whole(0, SWAPS) {
                if word.len() > 1 {
                    let at = chance.whole(1, word.len() - 1);
                    word.swap(at - 1, at);
                }
            }
            word
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_holds_every_symbol_once() {
        for mut word in shuffled_words(100, 12, 1) {
            word.sort_unstable();
            assert_eq!(word, (0..12).collect::<Vec<_>>());
        }
        assert_eq!(shuffled_words(2, 0, 1), [vec![], vec![]]);
    }
}
