//! From words alone to a specification.

use crate::import::Words;
use crate::pdfa::{Pdfa, Semantics, Symbol, Word};
use crate::specification::{DemonstrationWord, Specification, SubGoal};

/// Infers a specification from words alone, as they are read from a file, or one list of symbol names per demonstration.
/// The alphabet is in the order in which the names first appear.
///
/// # Complexity
///
/// That of [`Pdfa::from_words`]; the words are kept, not copied.
pub fn infer_words(name: &str, semantics: Semantics, words: impl Into<Words>) -> Specification {
    let Words { names, words, .. } = words.into();
    let pdfa = Pdfa::from_words(&words);
    let demonstrations_with = demonstrations_with(names.len(), &words);
    let sub_goals = names.into_iter().zip(demonstrations_with).zip((0..).map(Symbol)).map(
        |((name, demonstrations), id)| SubGoal {
            id,
            name,
            ball: None,
            frames: 0,
            demonstrations,
            color: None,
        },
    );
    let demonstrations = words.into_iter().zip(1..).map(|(word, number)| DemonstrationWord {
        name: format!("word {number}"),
        sha256: String::new(),
        frames: 0,
        word,
    });
    Specification {
        name: name.to_owned(),
        semantics,
        features: Vec::new(),
        subsets: Vec::new(),
        sub_goals: sub_goals.collect(),
        pdfa,
        demonstrations: demonstrations.collect(),
    }
}

/// For each of `symbols` symbols, how many words hold it.
fn demonstrations_with(symbols: usize, words: &[Word]) -> Vec<usize> {
    let mut counts = vec![0; symbols];
    let mut last = vec![0; symbols];
    for (word, number) in words.iter().zip(1..) {
        for symbol in word {
            let symbol = symbol.0 as usize;
            counts[symbol] += usize::from(last[symbol] != number);
            last[symbol] = number;
        }
    }
    counts
}
