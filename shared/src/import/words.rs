//! Words written by hand or by other programs, without demonstrations behind them.

use rustc_hash::FxHashMap;

use super::ImportError;
use super::text::{counted, quoted, text};
use crate::pdfa::{Symbol, Word};

/// Words over names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Words {
    /// The alphabet in the order in which the names first appear: `Symbol(n)` stands for the name at `n`.
    pub names: Vec<String>,
    /// Each word, in the order of the file.
    pub words: Vec<Word>,
    /// How many further words the file says are no words of the task; they are left out.
    pub rejected: usize,
}

/// Collects words; every name is kept once.
#[derive(Default)]
struct Collector<'a> {
    symbols: FxHashMap<&'a str, Symbol>,
    /// The word that is being read, so that its own memory is asked for once, as long as it is.
    word: Word,
    found: Words,
}

impl Words {
    /// The names of the symbols in `word`, which is one of these words.
    ///
    /// # Panics
    ///
    /// When `word` has a symbol that none of these words has.
    pub fn named<'a>(&'a self, word: &'a [Symbol]) -> impl Iterator<Item = &'a str> {
        word.iter().map(|symbol| self.names[symbol.0 as usize].as_str())
    }
}

impl<T: AsRef<[Vec<String>]> + ?Sized> From<&T> for Words {
    /// Words whose symbols are given by their names.
    fn from(words: &T) -> Self {
        let mut collector = Collector::default();
        for word in words.as_ref() {
            collector.push(word.iter().map(String::as_str));
        }
        collector.found
    }
}

impl<'a> Collector<'a> {
    fn push(&mut self, word: impl Iterator<Item = &'a str>) {
        let names = &mut self.found.names;
        self.word.clear();
        self.word.extend(word.map(|name| {
            *self.symbols.entry(name).or_insert_with(|| {
                names.push(name.to_owned());
                Symbol(names.len() as u32 - 1)
            })
        }));
        self.found.words.push(self.word.clone());
    }
}

/// Reads words: one a line, symbols separated by blanks; or in the Abbadingo format.
///
/// A blank line is no word, so the empty word can be written in the Abbadingo format only: a first line with the
/// number of words and of symbols, then `label length symbol symbol..` for each word, where label 1 marks the words
/// of the task and 0 the rejected ones. A file is in that format when its first line is two positive integers and
/// most of the other lines fit.
///
/// ```
/// use goalgraph::import::import_words;
///
/// let file = import_words(b"red green blue\nred blue green\n")?;
/// assert_eq!(file.names, ["red", "green", "blue"]);
/// assert!(file.named(&file.words[1]).eq(["red", "blue", "green"]));
///
/// let file = import_words(b"3 2\n1 2 0 1\n0 1 1\n1 0\n")?;
/// assert_eq!((file.words.len(), file.rejected), (2, 1));
/// # Ok::<(), goalgraph::import::ImportError>(())
/// ```
///
/// # Errors
///
/// When the file is no text or holds no words, and in the Abbadingo format when a line breaks it, the number of
/// words is not the one announced, or a label is neither 1 nor 0.
///
/// # Complexity
///
/// Linear in the number of bytes. A symbol takes 4 bytes, however long its name is.
pub fn import_words(bytes: &[u8]) -> Result<Words, ImportError> {
    let text = text(bytes, "words, one a line")?;
    let found = match announced(text) {
        Some(count) => abbadingo(text, count)?,
        None => words(text),
    };
    if found.words.is_empty() {
        let rejected = found.rejected;
        return Err(ImportError::whole(format!(
            "there are rejected words only ({rejected}); expected accepted ones"
        )));
    }
    Ok(found)
}

/// The lines that are not blank, with their numbers from 1.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty())
}

fn words(text: &str) -> Words {
    let mut collector = Collector::default();
    for (_, line) in lines(text) {
        collector.push(line.split_whitespace());
    }
    collector.found
}

/// The number of words in the first line of a file in the Abbadingo format.
fn announced(text: &str) -> Option<usize> {
    let mut lines = lines(text).map(|(_, line)| line);
    let mut first = lines.next()?.split_whitespace().map(str::parse);
    let (Some(Ok(count)), Some(Ok(symbols)), None) = (first.next(), first.next(), first.next()) else {
        return None;
    };
    let (mut fitting, mut others) = (0_usize, 0_usize);
    for line in lines {
        let fits = entry(line).is_ok_and(|(label, _)| ["1", "0", "-1"].contains(&label));
        *if fits { &mut fitting } else { &mut others } += 1;
    }
    let (count, symbols): (usize, usize) = (count, symbols);
    (count > 0 && symbols > 0 && fitting > others).then_some(count)
}

fn abbadingo(text: &str, announced: usize) -> Result<Words, ImportError> {
    let mut collector = Collector::default();
    for (number, line) in lines(text).skip(1) {
        let (label, word) = entry(line).map_err(|message| ImportError::at(number, message))?;
        match label {
            "1" => collector.push(word),
            "0" => collector.found.rejected += 1,
            _ => {
                let label = quoted(label);
                let message = format!("the label is {label}; expected 1 (accepted) or 0 (rejected)");
                return Err(ImportError::at(number, message));
            }
        }
    }
    let found = collector.found;
    let count = found.words.len() + found.rejected;
    if count != announced {
        let message = format!("the first line announces {announced} words, but {count} follow");
        return Err(ImportError::at(1, message));
    }
    Ok(found)
}

/// Label and symbols of a line `label length symbol symbol..`.
fn entry(line: &str) -> Result<(&str, impl Iterator<Item = &str>), String> {
    let mut cells = line.split_whitespace();
    let label = cells.next().unwrap_or_default();
    let length = cells.next().ok_or("expected a label, a length and the symbols")?;
    let count = cells.clone().count();
    let length: usize =
        length.parse().map_err(|_| format!("the length is {}; expected a whole number", quoted(length)))?;
    if length != count {
        return Err(format!("{}, but the length says {length}", counted(count, "symbol")));
    }
    Ok((label, cells))
}
