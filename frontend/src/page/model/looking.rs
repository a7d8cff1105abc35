//! What of the automaton is looked at, and how.

use std::sync::Arc;

use goalgraph::layout::Layout;
use goalgraph::pdfa::Symbol;
use goalgraph::specification::Specification;

/// The lists beside the graph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Side {
    /// Distinct words and conformance.
    #[default]
    Variants,
    /// States that may be one.
    Merges,
    /// What is wrong.
    Problems,
    /// What was done.
    History,
}

impl Side {
    /// All lists, from left to right.
    pub(crate) const ALL: [Self; 4] = [Self::Variants, Self::Merges, Self::Problems, Self::History];

    /// The name on the list.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Variants => "Variants",
            Self::Merges => "Merges",
            Self::Problems => "Problems",
            Self::History => "History",
        }
    }
}

/// The text beside the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TextPane {
    /// Graphviz syntax.
    Dot,
    /// The specification file.
    Json,
}

/// A placement of the whole automaton, asked for and given by the worker.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tidied {
    /// What had been learned or opened when it was asked for: a later one needs a placement of its own.
    pub(crate) of: Option<Arc<Specification>>,
    /// How many were asked for.
    pub(crate) asked: u32,
    /// Which of them was answered last.
    pub(crate) answered: u32,
    /// The answer, in each direction of drawing.
    pub(crate) layouts: Vec<Arc<Layout>>,
}

/// What is looked for in the automaton.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Search {
    /// The text; none while the field is closed.
    pub(crate) text: Option<String>,
    /// Which of the hits is on display.
    pub(crate) at: usize,
}

/// A walk through the automaton.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Simulation {
    /// Whether somebody walks at the moment.
    pub(crate) on: bool,
    /// The sub-goals completed so far.
    pub(crate) word: Vec<Symbol>,
    /// The seed of the words that are drawn.
    pub(crate) seed: u64,
}
