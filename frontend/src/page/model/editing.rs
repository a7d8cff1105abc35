//! What an expert is about to do with the automaton.

use std::collections::BTreeMap;

use goalgraph::edit::Edit;
use goalgraph::layout::Point;
use goalgraph::pdfa::{StateId, Symbol};

/// Something of the automaton that can be selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Selection {
    /// A state.
    State(StateId),
    /// The transition by a symbol out of a state.
    Transition(StateId, Symbol),
}

/// An edit that is thought of but not made: its consequence is shown, and nothing else happens.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Draft {
    /// What the history will call it.
    pub(crate) label: String,
    /// What would be done.
    pub(crate) edits: Vec<Edit>,
    /// Whether somebody has begun it: then it waits for an answer. Otherwise a pointer or the focus only rests on it.
    pub(crate) begun: bool,
}

/// What a pointer that is held down does in the drawing. Places are in the frame.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Gesture {
    /// It moves the drawing.
    Pan {
        /// Where the pointer was last.
        last: Point,
    },
    /// It moves states.
    Drag {
        /// Where the pointer went down.
        from: Point,
        /// Where the states were, in the drawing space.
        origins: BTreeMap<StateId, Point>,
        /// The state below the pointer that is none of them.
        over: Option<StateId>,
    },
    /// It draws a rectangle around what is to be selected.
    Marquee {
        /// Where the pointer went down.
        from: Point,
        /// Where it is.
        to: Point,
    },
    /// It leads an arrow from a state to another.
    Connect {
        /// The state.
        source: StateId,
        /// The transition whose end is moved; none when a new one is drawn.
        symbol: Option<Symbol>,
        /// Where the pointer is.
        to: Point,
        /// The state below it.
        over: Option<StateId>,
    },
}

/// A menu and where it is in the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Menu {
    /// From the left.
    pub(crate) x: f64,
    /// From the top.
    pub(crate) y: f64,
    /// What is in it.
    pub(crate) content: MenuContent,
}

/// What a menu offers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum MenuContent {
    /// The commands for what is selected.
    Commands,
    /// The sub-goals that a new transition can have.
    Symbols {
        /// Where it starts.
        source: StateId,
        /// Where it leads.
        target: StateId,
    },
}
