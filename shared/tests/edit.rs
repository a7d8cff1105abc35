//! Edits: what each does, that none breaks a specification, and that each can be undone.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may fail by panicking; the same numbers come out"
)]

#[path = "edit/any_edits.rs"]
mod any_edits;
#[path = "edit/folding.rs"]
mod folding;
#[path = "edit/generate.rs"]
mod generate;
#[path = "edit/names.rs"]
mod names;
#[path = "edit/pruning.rs"]
mod pruning;
#[path = "edit/reweighting.rs"]
mod reweighting;
#[path = "edit/structure.rs"]
mod structure;
#[path = "edit/sub_goals.rs"]
mod sub_goals;
#[path = "edit/words.rs"]
mod words;

use goalgraph::edit::{Change, Edit};
use goalgraph::pdfa::{Semantics, StateId, Symbol, Word};
use goalgraph::specification::Specification;

/// A word written in letters: `a` is g0.
fn word(letters: &str) -> Word {
    letters.bytes().map(|letter| Symbol(u32::from(letter - b'a'))).collect()
}

/// The specification that these words give.
fn learned(words: &[&str]) -> Specification {
    generate::learned(&words.iter().map(|letters| word(letters)).collect::<Vec<_>>())
}

fn q(id: u32) -> StateId {
    StateId(id)
}

const A: Symbol = Symbol(0);
const B: Symbol = Symbol(1);
const C: Symbol = Symbol(2);
const D: Symbol = Symbol(3);

/// What the edit makes of the specification.
#[track_caller]
fn edited(specification: &Specification, edit: &Edit) -> (Specification, Change) {
    let mut after = specification.clone();
    let change = edit.apply(&mut after).unwrap_or_else(|error| panic!("{error}"));
    generate::assert_sound(&after);
    (after, change)
}

/// The edit is refused with this sentence and changes nothing.
#[track_caller]
fn refused(specification: &Specification, edit: &Edit, sentence: &str) {
    let mut after = specification.clone();
    assert_eq!(edit.apply(&mut after).unwrap_err().to_string(), sentence);
    assert_eq!(&after, specification);
}

/// Probability of a word, read by maximum likelihood.
fn probability(specification: &Specification, word: &[Symbol]) -> f64 {
    let pdfa = &specification.pdfa;
    pdfa.word_probability(word, &pdfa.probabilities(Semantics::MaximumLikelihood))
}

/// All words of at most `length` symbols.
fn all_words(length: usize) -> Vec<Word> {
    let mut all = vec![Word::new()];
    let mut from = 0;
    for _ in 0..length {
        let to = all.len();
        for at in from..to {
            let longer = (0..generate::ALPHABET).map(|id| [all[at].as_slice(), &[Symbol(id)]].concat());
            all.extend(longer.collect::<Vec<_>>());
        }
        from = to;
    }
    all
}

/// The words of at most `length` symbols that are accepted, in letters.
fn language(specification: &Specification, length: usize) -> Vec<String> {
    let accepted = all_words(length).into_iter().filter(|word| probability(specification, word) > 0.0);
    accepted.map(|word| word.iter().map(|symbol| char::from(b'a' + symbol.0 as u8)).collect()).collect()
}
