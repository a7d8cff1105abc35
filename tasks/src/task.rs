//! What a generated task consists of.

use std::collections::BTreeSet;
use std::ops::Range;

/// A task with its recorded demonstrations and the truth behind them.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// Short name, fit for a file name.
    pub name: String,
    /// What was drawn for it, in one line, for failure messages.
    pub description: String,
    /// Names of the columns of a frame.
    pub features: Vec<String>,
    /// Unit of every value.
    pub unit: Unit,
    /// Frames per second.
    pub rate_hz: f64,
    /// One subset for each thing that moves; together they hold every feature once, in column order.
    pub subsets: Vec<TrueSubset>,
    /// The true sub-goals: where a thing is put down, or where a drone or an arm stops by intention.
    pub places: Vec<Place>,
    /// The demonstrations, at least one of which visits each place.
    pub demonstrations: Vec<Recording>,
}

/// The features of one thing that moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrueSubset {
    /// Name of the thing: what its features have in common.
    pub name: String,
    /// Names of its features, in column order.
    pub features: Vec<String>,
}

/// A true sub-goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Unique in the task.
    pub name: String,
    /// Name of the subset that comes to rest here.
    pub subset: String,
    /// The spot aimed at, one coordinate for each feature of the subset, in the task's unit.
    ///
    /// The mean over the demonstrations is off by what their placement jitter averages to.
    pub center: Vec<f64>,
}

/// One demonstration.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Unique in the task, fit for a file name.
    pub name: String,
    /// Frames by features, in the task's unit; NaN is undefined.
    pub frames: Vec<Vec<f64>>,
    /// Indices into [`Task::places`] in the order of placing, each at most once.
    pub word: Vec<usize>,
    /// One rest for each symbol of the word, in the same order.
    pub rests: Vec<Rest>,
}

/// How long a thing truly stayed at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rest {
    /// Index into [`Task::places`].
    pub place: usize,
    /// From the frame of arrival to the frame in which the thing moves again, or to the end.
    pub frames: Range<usize>,
}

/// Unit of the recorded values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// m
    Metre,
    /// mm
    Millimetre,
    /// rad
    Radian,
}

impl Unit {
    /// How many of this unit make the metre (or the radian) that motion is computed in.
    pub fn per_base(self) -> f64 {
        match self {
            Unit::Metre | Unit::Radian => 1.0,
            Unit::Millimetre => 1000.0,
        }
    }

    /// Decimals of a written value: a hundredth of a millimetre, or of a milliradian.
    pub fn decimals(self) -> usize {
        match self {
            Unit::Metre | Unit::Radian => 5,
            Unit::Millimetre => 2,
        }
    }
}

impl Task {
    /// The distinct true words.
    pub fn distinct_words(&self) -> BTreeSet<&[usize]> {
        self.demonstrations.iter().map(|demonstration| demonstration.word.as_slice()).collect()
    }

    /// The columns of the subset with this name; empty when there is none.
    pub fn columns(&self, subset: &str) -> Range<usize> {
        let mut first = 0;
        for candidate in &self.subsets {
            let end = first + candidate.features.len();
            if candidate.name == subset {
                return first..end;
            }
            first = end;
        }
        first..first
    }

    /// Smallest distance between two places of one subset, in the task's unit; `None` when no subset has two.
    ///
    /// A found sub-goal less than half of it away from a place can mean no other place.
    pub fn separation(&self) -> Option<f64> {
        let pairs = self.places.iter().enumerate().flat_map(|(index, place)| {
            self.places[..index]
                .iter()
                .filter(|other| other.subset == place.subset)
                .map(|other| distance(&place.center, &other.center))
        });
        pairs.min_by(f64::total_cmp)
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}
