//! Words to make an automaton of.

use goalgraph::pdfa::{Symbol, Word};
use goalgraph_tasks::shuffled_words;

/// How many symbols each word has, all different.
pub const SYMBOLS_OF_A_WORD: usize = 12;

/// Words of twelve symbols with about `symbols` symbols in all.
pub fn words(symbols: usize) -> Vec<Word> {
    let of_numbers = shuffled_words(symbols.div_ceil(SYMBOLS_OF_A_WORD), SYMBOLS_OF_A_WORD as u32, 1);
    of_numbers.into_iter().map(|word| word.into_iter().map(Symbol).collect()).collect()
}

/// The same words as text, one a line.
pub fn text(words: &[Word]) -> String {
    let mut text = String::new();
    for word in words {
        let names: Vec<String> = word.iter().map(ToString::to_string).collect();
        text += &names.join(" ");
        text.push('\n');
    }
    text
}

/// The sum of all symbols: what reading them costs at least.
pub fn sum(words: &[Word]) -> u64 {
    words.iter().flatten().map(|symbol| u64::from(symbol.0)).sum()
}

#[cfg(test)]
mod tests {
    use goalgraph::import::import_words;

    use super::*;

    #[test]
    fn the_text_holds_the_words() {
        let words = words(100);
        assert_eq!((words.len(), sum(&words)), (9, 9 * 66));
        let read = import_words(text(&words).as_bytes()).unwrap();
        assert_eq!(read.words.len(), 9);
        assert_eq!(read.names[read.words[8][11].0 as usize], words[8][11].to_string());
    }
}
