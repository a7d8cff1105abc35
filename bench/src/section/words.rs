//! Words to an automaton.

use anyhow::Result;
use goalgraph::import::import_words;
use goalgraph::infer::infer_words;
use goalgraph::pdfa::{Pdfa, Semantics};
use goalgraph_bench::words::{SYMBOLS_OF_A_WORD, sum, text, words};

use crate::Options;
use crate::measure::{seconds, take_turns, threads};
use crate::report::{Bar, Report, figures, power, times};

/// Millions of symbols a second that are enough.
const ENOUGH: f64 = 20.0;

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    for symbols in options.sizes().into_iter().filter(|&symbols| symbols >= 100_000) {
        let words = words(symbols);
        let text = text(&words);
        let one = threads(1)?;
        let turns = take_turns([
            &mut || Ok(one.install(|| seconds(|| Pdfa::from_words(&words)))),
            &mut || Ok(seconds(|| sum(&words))),
            &mut || Ok(one.install(|| seconds(|| from_text(&text)))),
        ])?;
        let rate = |side: usize| (words.len() * SYMBOLS_OF_A_WORD) as f64 / turns.seconds(side) / 1e6;
        let measured = |side: usize| {
            format!("{}, {} million symbols a second", times(turns.ratio(side, 1)), figures(rate(side)))
        };
        let bar = Bar::at_least(ENOUGH, rate(0), " million a second");
        report.row_with_bar(format!("{} symbols", power(symbols)), measured(0), bar);
        report.row(format!("{} symbols, read from text", power(symbols)), measured(2));
    }
    Ok(())
}

fn from_text(text: &str) -> usize {
    let words = import_words(text.as_bytes()).unwrap_or_default();
    infer_words("words", Semantics::default(), words).pdfa.states.len()
}
