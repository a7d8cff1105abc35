//! What is measured, one file a section, in the order of the tables.

mod aalpy;
#[cfg(feature = "peers")]
mod another;
mod clustering;
mod inference;
mod instructions;
mod layout;
mod memory;
mod reading;
mod scikit_learn;
mod threads;
mod webassembly;
mod whole_way;
mod words;

use anyhow::{Result, bail};

use crate::Options;
use crate::report::Report;

/// A table.
struct Section {
    name: &'static str,
    title: &'static str,
    /// Whether `--peers` is needed for it.
    needs_peers: bool,
    /// Whether what it needs was given.
    is_possible: fn(&Options) -> bool,
    run: fn(&Options, &mut Report) -> Result<()>,
}

const fn own(
    name: &'static str,
    title: &'static str,
    run: fn(&Options, &mut Report) -> Result<()>,
) -> Section {
    Section { name, title, needs_peers: false, is_possible: |_| true, run }
}

const SECTIONS: &[Section] = &[
    own(
        "clustering",
        "Clustering, one thread, against sorting the points by one coordinate",
        clustering::run,
    ),
    own("memory", "Most memory at once, the points included, against the points' own size", memory::run),
    own("threads", "All threads against one", threads::run),
    own("reading", "Reading CSV, against copying and against SHA-256 of the same bytes", reading::run),
    own("words", "Words to automaton, against adding up the symbols of the same words", words::run),
    own(
        "inference",
        "The whole inference, one thread, against reading the same frames from CSV",
        inference::run,
    ),
    own("layout", "Layout, against the inference of the same automaton", layout::run),
    own("instructions", "Instructions, counted by Callgrind", instructions::run),
    Section {
        name: "webassembly",
        title: "WebAssembly in Chromium against native, one thread",
        needs_peers: true,
        is_possible: |options| options.webassembly.is_some() && options.chromium.is_some(),
        run: webassembly::run,
    },
    Section {
        name: "scikit-learn",
        title: "scikit-learn's DBSCAN against ours, both on one thread and on the same points",
        needs_peers: true,
        is_possible: |options| options.python.is_some(),
        run: scikit_learn::run,
    },
    #[cfg(feature = "peers")]
    Section {
        name: "another",
        title: "petal-clustering's DBSCAN (Rust) against ours, both on one thread and on the same points",
        needs_peers: true,
        is_possible: |_| true,
        run: another::run,
    },
    Section {
        name: "aalpy",
        title: "AALpy's prefix tree against our automaton, from the same words",
        needs_peers: true,
        is_possible: |options| options.python.is_some(),
        run: aalpy::run,
    },
    Section {
        name: "whole-way",
        title: "Nine demonstrations of 300 frames, from the start to words",
        needs_peers: true,
        is_possible: |options| options.python.is_some() && options.goalgraph.is_some(),
        run: whole_way::run,
    },
];

/// Measures the sections that were asked for, or all that are possible.
///
/// # Errors
///
/// When a section is not known, lacks what it needs, or fails.
pub(crate) fn measure(options: &Options) -> Result<Report> {
    for name in &options.only {
        let Some(section) = SECTIONS.iter().find(|section| section.name == name) else {
            let known: Vec<&str> = SECTIONS.iter().map(|section| section.name).collect();
            bail!("there is no section {name:?}; there are: {}", known.join(", "));
        };
        if !(section.is_possible)(options) {
            bail!("section {name} needs --peers");
        }
    }
    let mut report = Report::default();
    for section in SECTIONS {
        let is_wanted = options.only.is_empty() || options.only.iter().any(|name| name == section.name);
        if is_wanted && (section.is_possible)(options) {
            report.begin(section.title, section.name, section.needs_peers);
            (section.run)(options, &mut report)?;
        }
    }
    Ok(report)
}
