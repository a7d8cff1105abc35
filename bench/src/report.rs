//! Rows of figures, the tables and the page that they end in.

mod chart;
mod page;

use std::path::Path;

use anyhow::Result;

use crate::measure::Spread;

/// All that was measured.
#[derive(Default)]
pub(crate) struct Report {
    tables: Vec<Table>,
    curves: Vec<Curve>,
}

/// What one section measured.
struct Table {
    title: &'static str,
    /// What measures it again.
    command: String,
    rows: Vec<Row>,
}

/// One figure.
struct Row {
    what: String,
    measured: String,
    bar: Option<Bar>,
}

/// What a figure is held against.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bar {
    text: String,
    is_met: bool,
}

impl Bar {
    /// `value`, in `unit`, has to be at least `least`.
    pub(crate) fn at_least(least: f64, value: f64, unit: &str) -> Self {
        Self { text: format!("at least {least}{unit}"), is_met: value >= least }
    }

    /// `value`, in `unit`, has to be at most `most`.
    pub(crate) fn at_most(most: f64, value: f64, unit: &str) -> Self {
        Self { text: format!("at most {most}{unit}"), is_met: value <= most }
    }
}

/// How the time of something grows.
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) whose: Whose,
    /// Number of points, and seconds.
    pub(crate) times: Vec<(usize, f64)>,
}

/// Who takes that time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Whose {
    Ours,
    Peers,
}

impl Report {
    /// The rows from here on are those of a section.
    pub(crate) fn begin(&mut self, title: &'static str, section: &str, needs_peers: bool) {
        eprintln!("{title}");
        let peers = if needs_peers { " --peers" } else { "" };
        let command = format!("cargo xtask bench{peers} --only {section}");
        self.tables.push(Table { title, command, rows: Vec::new() });
    }

    /// A figure.
    pub(crate) fn row(&mut self, what: impl Into<String>, measured: impl Into<String>) {
        self.push(what.into(), measured.into(), None);
    }

    /// A figure that is held against a bar.
    pub(crate) fn row_with_bar(&mut self, what: impl Into<String>, measured: impl Into<String>, bar: Bar) {
        self.push(what.into(), measured.into(), Some(bar));
    }

    /// A curve of the chart, where there is anything of it.
    pub(crate) fn curve(&mut self, name: impl Into<String>, whose: Whose, times: &[(usize, f64)]) {
        if !times.is_empty() {
            self.curves.push(Curve { name: name.into(), whose, times: times.to_vec() });
        }
    }

    /// The tables, for a reader of Markdown.
    pub(crate) fn markdown(&self) -> String {
        self.tables.iter().map(Table::markdown).collect::<Vec<_>>().join("\n")
    }

    /// Puts the tables into the page of `docs`, and the chart where our own curves were measured.
    ///
    /// # Errors
    ///
    /// When a file cannot be read or written.
    pub(crate) fn write(&self, docs: &Path) -> Result<()> {
        let tables = self
            .tables
            .iter()
            .map(|table| page::PageTable { command: table.command.clone(), markdown: table.markdown() });
        page::write(docs, &tables.collect::<Vec<_>>())?;
        let ours = self.curves.iter().any(|curve| curve.whose == Whose::Ours);
        if let Some(chart) = chart::draw(&self.curves).filter(|_| ours) {
            std::fs::write(docs.join("performance.svg"), chart)?;
        }
        Ok(())
    }

    fn push(&mut self, what: String, measured: String, bar: Option<Bar>) {
        let row = Row { what, measured, bar };
        eprintln!("  {}", row.markdown());
        if let Some(table) = self.tables.last_mut() {
            table.rows.push(row);
        }
    }
}

impl Table {
    fn markdown(&self) -> String {
        let rows: Vec<String> = self.rows.iter().map(Row::markdown).collect();
        let heads = "| what | measured | bar |\n| --- | --- | --- |";
        format!("### {}\n\n`{}`\n\n{heads}\n{}\n", self.title, self.command, rows.join("\n"))
    }
}

impl Row {
    fn markdown(&self) -> String {
        let bar = self.bar.as_ref().map(|bar| {
            let verdict = if bar.is_met { "met" } else { "**missed**" };
            format!("{}: {verdict}", bar.text)
        });
        format!("| {} | {} | {} |", self.what, self.measured, bar.unwrap_or_default())
    }
}

/// `12.3x (11.8 to 14.0)`: the median and between what the turns lay.
pub(crate) fn times(ratio: Spread) -> String {
    let Spread { median, least, most } = ratio;
    format!("{}x ({} to {})", figures(median), figures(least), figures(most))
}

/// Three figures: nobody reads more.
pub(crate) fn figures(value: f64) -> String {
    let decimals = match value.abs() {
        0.0..0.1 => 4,
        0.1..1.0 => 3,
        1.0..10.0 => 2,
        10.0..100.0 => 1,
        _ => 0,
    };
    format!("{value:.decimals$}")
}

/// `10^6`, or the number where it is no power of ten.
pub(crate) fn power(number: usize) -> String {
    let exponent = number.max(1).ilog10();
    if 10_usize.pow(exponent) == number && exponent > 2 {
        return format!("10^{exponent}");
    }
    number.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_as_exact_as_a_reader_needs() {
        let text = [0.01234, 0.1234, 1.234, 12.34, 123.4, 1234.0].map(figures);
        assert_eq!(text, ["0.0123", "0.123", "1.23", "12.3", "123", "1234"]);
        assert_eq!([1_000_000, 30_000, 100, 0].map(power), ["10^6", "30000", "100", "0"]);
    }

    #[test]
    fn a_missed_bar_is_said() {
        let mut report = Report::default();
        report.begin("Growth", "growth", false);
        report.row_with_bar("points", "1.20", Bar::at_most(1.1, 1.2, ""));
        report.row_with_bar(
            "noise",
            times(Spread { median: 4.0, least: 3.0, most: 5.0 }),
            Bar::at_least(3.0, 4.0, "x"),
        );
        report.row("blobs", "1");
        let expected = "### Growth\n\n`cargo xtask bench --only growth`\n\n| what | measured | bar |\n\
            | --- | --- | --- |\n| points | 1.20 | at most 1.1: **missed** |\n\
            | noise | 4.00x (3.00 to 5.00) | at least 3x: met |\n| blobs | 1 |  |\n";
        assert_eq!(report.markdown(), expected);
    }
}
