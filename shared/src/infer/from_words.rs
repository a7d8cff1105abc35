//! From words alone to a specification.

use std::collections::BTreeMap;

use crate::pdfa::{Pdfa, Semantics, Symbol, Word};
use crate::specification::{DemonstrationWord, Specification, SubGoal};

/// Infers a specification from words alone: one list of symbol names per demonstration. The alphabet is in the order in
/// which the names first appear.
///
/// # Complexity
///
/// O(S log A) for S symbols in all words and A names.
pub fn infer_words(name: &str, semantics: Semantics, named_words: &[Vec<String>]) -> Specification {
    let mut symbols: BTreeMap<&str, Symbol> = BTreeMap::new();
    let mut sub_goals: Vec<SubGoal> = Vec::new();
    let mut demonstrations = Vec::new();
    for (number, named_word) in named_words.iter().enumerate() {
        let mut word = Word::new();
        for symbol_name in named_word {
            let symbol = *symbols.entry(symbol_name).or_insert_with(|| {
                let id = Symbol(sub_goals.len() as u32);
                let name = symbol_name.clone();
                sub_goals.push(SubGoal { id, name, ball: None, frames: 0, demonstrations: 0, color: None });
                id
            });
            if !word.contains(&symbol) {
                sub_goals[symbol.0 as usize].demonstrations += 1;
            }
            word.push(symbol);
        }
        let name = format!("word {}", number + 1);
        demonstrations.push(DemonstrationWord { name, sha256: String::new(), frames: 0, word });
    }
    let words: Vec<Word> = demonstrations.iter().map(|demonstration| demonstration.word.clone()).collect();
    Specification {
        name: name.to_owned(),
        semantics,
        features: Vec::new(),
        subsets: Vec::new(),
        sub_goals,
        pdfa: Pdfa::from_words(&words),
        demonstrations,
    }
}
