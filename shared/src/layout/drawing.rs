//! What states and transitions look like: every size of the drawing, in one place.
//!
//! The page and the exported image are drawn from this, so that they agree. A state is a box with its id on top and a chip
//! for every completed sub-goal below; a transition has a label of two lines. Lengths are pixels of the drawing space.

mod text;

use super::geometry::{Point, Rect};
use super::{Direction, EdgeRequest, LayoutRequest, NodeRequest};
use crate::pdfa::{Probabilities, State, StateId, Symbol, Transition};
use crate::specification::Specification;

pub use text::{probability_text, shortened, text_width};

/// Size of the text on chips and of the first line of labels.
pub const TEXT_SIZE: f64 = 12.0;
/// Size of the text that is less important: ids of states, second line of labels.
pub const SMALL_TEXT_SIZE: f64 = 11.0;
/// Up to how many characters of a name are shown.
pub const MAX_NAME_CHARACTERS: usize = 18;
/// Room between the border of a state's box and what is in it.
pub const BOX_PADDING: f64 = 9.0;
/// Least width of a state's box.
pub const MIN_BOX_WIDTH: f64 = 56.0;
/// Radius of the corners of a state's box.
pub const BOX_RADIUS: f64 = 10.0;
/// Height of the line with a state's id.
pub const TITLE_HEIGHT: f64 = 14.0;
/// Room between the id and the chips.
pub const TITLE_GAP: f64 = 5.0;
/// Height of a chip.
pub const CHIP_HEIGHT: f64 = 19.0;
/// Room between a chip's ends and its text.
pub const CHIP_PADDING: f64 = 7.0;
/// Room between chips.
pub const CHIP_GAP: f64 = 4.0;
/// Chips in a row at most.
pub const CHIPS_PER_ROW: usize = 4;
/// How far the second border of an accepting state is within the first.
pub const SECOND_BORDER: f64 = 3.5;
/// Height of a line of a transition's label.
pub const LABEL_LINE_HEIGHT: f64 = 14.0;

/// How a state is drawn, around the center of its box.
#[derive(Clone, Debug, PartialEq)]
pub struct StateDrawing {
    /// Width of the box.
    pub width: f64,
    /// Height of the box.
    pub height: f64,
    /// The id, the name where there is one, and how probable it is that the task ends here where it may also go on.
    pub title: String,
    /// Center of the title.
    pub title_at: Point,
    /// One for every completed sub-goal, in the order of the alphabet.
    pub chips: Vec<Chip>,
    /// What stands in the place of chips when there are none, such as `start`.
    pub note: Option<&'static str>,
    /// Center of the note.
    pub note_at: Point,
    /// Whether the box has a second border.
    pub accepting: bool,
}

/// A completed sub-goal in a state's box.
#[derive(Clone, Debug, PartialEq)]
pub struct Chip {
    /// The sub-goal.
    pub symbol: Symbol,
    /// Its name, shortened.
    pub text: String,
    /// Where it is, around the center of the state's box.
    pub rect: Rect,
}

/// What is written at a transition.
#[derive(Clone, Debug, PartialEq)]
pub struct TransitionLabel {
    /// Name of the sub-goal, shortened.
    pub name: String,
    /// Probability, and how many of the words that came to the source took this way: `0.67 · 6/9`.
    pub evidence: String,
    /// Width of both lines.
    pub width: f64,
    /// Height of both lines.
    pub height: f64,
}

/// The request for the drawing of `specification`, from left to right.
///
/// # Complexity
///
/// O(Q · A + T) for Q states, T transitions and A sub-goals.
pub fn layout_request(specification: &Specification) -> LayoutRequest {
    let pdfa = &specification.pdfa;
    let probabilities = pdfa.probabilities(specification.semantics);
    let node = |(&id, state): (&StateId, &State)| {
        let drawing = state_drawing(specification, &probabilities, id, state);
        NodeRequest { id, width: drawing.width, height: drawing.height }
    };
    let edge = |(source, symbol, transition): (StateId, Symbol, &Transition)| {
        let label = transition_label(specification, &probabilities, source, symbol);
        let (label_width, label_height) = (label.width, label.height);
        EdgeRequest { source, symbol, target: transition.target, label_width, label_height }
    };
    LayoutRequest {
        nodes: pdfa.states.iter().map(node).collect(),
        edges: pdfa.transitions().map(edge).collect(),
        initial: pdfa.initial,
        direction: Direction::LeftToRight,
    }
}

/// How the state `id` of `specification` is drawn; `probabilities` are those of its automaton.
pub fn state_drawing(
    specification: &Specification,
    probabilities: &Probabilities,
    id: StateId,
    state: &State,
) -> StateDrawing {
    let name = state.name.as_ref().map(|name| format!(" · {}", shortened(name, MAX_NAME_CHARACTERS)));
    let ends = (state.accepting && !state.transitions.is_empty())
        .then(|| format!(" · ends {}", probability_text(probabilities.end(id))));
    let title = format!("{id}{}{}", name.unwrap_or_default(), ends.unwrap_or_default());
    let note = state.completed.is_empty().then_some(if id == specification.pdfa.initial {
        "start"
    } else {
        "nothing done"
    });
    let rows = chip_rows(specification, state);
    let content = rows.iter().map(|row| row_width(row)).fold(text_width(&title, SMALL_TEXT_SIZE), f64::max);
    let content = note.map_or(content, |note| content.max(text_width(note, TEXT_SIZE)));
    let lines = rows.len().max(1) as f64;
    let width = (content + 2.0 * BOX_PADDING).max(MIN_BOX_WIDTH);
    let height = 2.0 * BOX_PADDING + TITLE_HEIGHT + TITLE_GAP + lines * (CHIP_HEIGHT + CHIP_GAP) - CHIP_GAP;
    let top = BOX_PADDING - height / 2.0;
    let chips_top = top + TITLE_HEIGHT + TITLE_GAP;
    StateDrawing {
        width,
        height,
        title,
        title_at: Point::new(0.0, top + TITLE_HEIGHT / 2.0),
        chips: rows.into_iter().enumerate().flat_map(|(at, row)| placed_row(at, row, chips_top)).collect(),
        note,
        note_at: Point::new(0.0, chips_top + CHIP_HEIGHT / 2.0),
        accepting: state.accepting,
    }
}

/// Symbols and texts of a state's chips, in rows of about equal length.
fn chip_rows(specification: &Specification, state: &State) -> Vec<Vec<(Symbol, String)>> {
    let chip = |&symbol: &Symbol| (symbol, shortened(&specification.name_of(symbol), MAX_NAME_CHARACTERS));
    let chips: Vec<(Symbol, String)> = state.completed.iter().map(chip).collect();
    let rows = chips.len().div_ceil(CHIPS_PER_ROW).max(1);
    chips.chunks(chips.len().div_ceil(rows).max(1)).map(<[_]>::to_vec).collect()
}

fn chip_width(text: &str) -> f64 {
    text_width(text, TEXT_SIZE) + 2.0 * CHIP_PADDING
}

fn row_width(row: &[(Symbol, String)]) -> f64 {
    row.iter().map(|(_, text)| chip_width(text) + CHIP_GAP).sum::<f64>() - CHIP_GAP
}

fn placed_row(at: usize, row: Vec<(Symbol, String)>, chips_top: f64) -> Vec<Chip> {
    let top = chips_top + at as f64 * (CHIP_HEIGHT + CHIP_GAP);
    let mut left = -row_width(&row) / 2.0;
    let mut chips = Vec::with_capacity(row.len());
    for (symbol, text) in row {
        let right = left + chip_width(&text);
        chips.push(Chip { symbol, text, rect: Rect { left, top, right, bottom: top + CHIP_HEIGHT } });
        left = right + CHIP_GAP;
    }
    chips
}

/// What is written at the transition by `symbol` out of `source`; `probabilities` are those of the automaton.
pub fn transition_label(
    specification: &Specification,
    probabilities: &Probabilities,
    source: StateId,
    symbol: Symbol,
) -> TransitionLabel {
    let name = shortened(&specification.name_of(symbol), MAX_NAME_CHARACTERS);
    let state = specification.pdfa.states.get(&source);
    let count = specification.pdfa.transition(source, symbol).map_or(0, |transition| transition.count);
    let total = state.map_or(0, words_through);
    let probability = probability_text(probabilities.transition(source, symbol));
    let evidence = format!("{probability} · {count}/{total}");
    let width = text_width(&name, TEXT_SIZE).max(text_width(&evidence, SMALL_TEXT_SIZE));
    TransitionLabel { name, evidence, width, height: 2.0 * LABEL_LINE_HEIGHT }
}

/// How many words came through a state: those that went on and those that ended.
pub fn words_through(state: &State) -> u64 {
    let counts = state.transitions.values().map(|transition| transition.count);
    counts.fold(state.end_count, u64::saturating_add)
}

/// Which of a palette's colors a sub-goal has: sub-goals of one feature subset share theirs, those without a place have one
/// each. Whoever draws takes it modulo the number of colors.
pub fn color_index(specification: &Specification, symbol: Symbol) -> usize {
    let subset =
        specification.sub_goal(symbol).and_then(|sub_goal| sub_goal.ball.as_ref()).map(|ball| &ball.subset);
    let by_subset =
        subset.and_then(|name| specification.subsets.iter().position(|subset| subset.name == *name));
    let in_alphabet = || specification.sub_goals.iter().position(|sub_goal| sub_goal.id == symbol);
    by_subset.or_else(in_alphabet).unwrap_or(0)
}
