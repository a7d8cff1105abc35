//! AALpy beside us, on the same words.

use std::process::Command;

use anyhow::{Context, Result};
use goalgraph::pdfa::Pdfa;
use goalgraph_bench::words::{SYMBOLS_OF_A_WORD, text, words};

use crate::Options;
use crate::measure::{seconds, take_turns, threads};
use crate::peer::{GivenUp, Peer};
use crate::report::{Report, figures, power, times};

/// What AALpy is asked to do, and with how many symbols.
const ORDERS: [(&str, &str, usize); 3] = [
    ("prefix tree", "tree", 120_000),
    ("prefix tree", "tree", 1_200_000),
    ("the whole of Alergia", "alergia", 120_000),
];

pub(super) fn run(options: &Options, report: &mut Report) -> Result<()> {
    let python = options.python.as_deref().context("no Python was given")?;
    for (what, order, symbols) in ORDERS {
        let what = format!("{what}, {} symbols", power(symbols));
        let words = words(symbols);
        let folder = tempfile::tempdir()?;
        let file = folder.path().join("words.txt");
        std::fs::write(&file, text(&words))?;
        let mut command = Command::new(python);
        command.arg(options.script("prefix_tree.py")).arg(&file);
        let mut peer = Peer::start(&command, true)?;
        let one = threads(1)?;
        let turns = take_turns([&mut || peer.turn(order), &mut || {
            Ok(one.install(|| seconds(|| Pdfa::from_words(&words))))
        }]);
        match turns {
            Ok(turns) => {
                let rate = (words.len() * SYMBOLS_OF_A_WORD) as f64 / turns.seconds(0) / 1e6;
                let theirs = format!("theirs {} million symbols a second", figures(rate));
                report.row(what, format!("{}, {theirs}", times(turns.ratio(0, 1))));
            }
            Err(error) => report.row(what, error.downcast::<GivenUp>()?.to_string()),
        }
    }
    Ok(())
}
