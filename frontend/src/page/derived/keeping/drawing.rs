//! What differs between two specifications, as it is drawn and listed.

use std::collections::BTreeMap;

use goalgraph::difference::{Change, Difference, StateSide, TransitionSide, difference};
use goalgraph::layout::LayoutRequest;
use goalgraph::layout::drawing::{
    MAX_NAME_CHARACTERS, SMALL_TEXT_SIZE, TEXT_SIZE, layout_request, probability_text, shortened, text_width,
};
use goalgraph::pdfa::{StateId, Symbol};
use goalgraph::specification::Specification;

use crate::page::colors::{Color, colors};

/// A difference with what drawing it needs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drawing {
    /// What differs.
    pub(crate) difference: Difference,
    /// The boxes and arrows of both together.
    pub(crate) request: LayoutRequest,
    /// The color of every sub-goal of both.
    pub(crate) colors: BTreeMap<Symbol, Color>,
}

/// How something of the drawing differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sign {
    /// It came.
    Added,
    /// It went.
    Removed,
    /// It is not what it was.
    Changed,
}

impl Sign {
    /// How a change is drawn.
    pub(crate) fn of<T>(change: &Change<T>) -> Self {
        match (&change.before, &change.after) {
            (None, _) => Self::Added,
            (_, None) => Self::Removed,
            _ => Self::Changed,
        }
    }

    /// The sign before it.
    pub(crate) fn sign(self) -> &'static str {
        match self {
            Self::Added => "+",
            Self::Removed => "\u{2212}",
            Self::Changed => "~",
        }
    }

    /// The class of it.
    pub(crate) fn class(self) -> &'static str {
        match self {
            Self::Added => "added",
            Self::Removed => "removed",
            Self::Changed => "changed",
        }
    }

    /// What it is called.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Added => "Added",
            Self::Removed => "Removed",
            Self::Changed => "Changed",
        }
    }
}

/// Room for the sign before a state's id.
const SIGN_WIDTH: f64 = 14.0;

impl Drawing {
    /// What differs between two specifications.
    pub(super) fn of(before: &Specification, after: &Specification) -> Self {
        let difference = difference(before, after);
        let mut request = layout_request(&difference.union);
        for node in &mut request.nodes {
            node.width += if difference.states.contains_key(&node.id) { SIGN_WIDTH } else { 0.0 };
        }
        let mut drawing = Self { colors: colors(&difference.union), difference, request };
        let widths: Vec<f64> =
            drawing.request.edges.iter().map(|it| drawing.width(it.source, it.symbol)).collect();
        for (edge, width) in drawing.request.edges.iter_mut().zip(widths) {
            edge.label_width = width;
        }
        drawing
    }

    fn width(&self, source: StateId, symbol: Symbol) -> f64 {
        let (name, chance) = self.label(source, symbol);
        text_width(&name, TEXT_SIZE).max(text_width(&chance, SMALL_TEXT_SIZE))
    }

    /// How a state differs; none when it does not.
    pub(crate) fn state_sign(&self, id: StateId) -> Option<Sign> {
        self.difference.states.get(&id).map(Sign::of)
    }

    /// How a transition differs; none when it does not.
    pub(crate) fn transition_sign(&self, source: StateId, symbol: Symbol) -> Option<Sign> {
        self.difference.transitions.get(&(source, symbol)).map(Sign::of)
    }

    /// What is written at a transition: its sub-goal, and its probability with what became of it.
    pub(crate) fn label(&self, source: StateId, symbol: Symbol) -> (String, String) {
        let name = shortened(&self.difference.union.name_of(symbol), MAX_NAME_CHARACTERS);
        let chance = match self.difference.transitions.get(&(source, symbol)) {
            Some(change) => chance_of(change),
            None => probability_text(self.difference.chances.get(&(source, symbol)).copied().unwrap_or(0.0)),
        };
        (name, chance)
    }
}

fn chance_of(change: &Change<TransitionSide>) -> String {
    let sign = Sign::of(change).sign();
    match (&change.before, &change.after) {
        (Some(old), Some(new)) => {
            let (before, after) = (probability_text(old.probability), probability_text(new.probability));
            if before == after {
                format!("{after} · {} → {} shown", old.count, new.count)
            } else {
                format!("{before} → {after}")
            }
        }
        (Some(side), None) | (None, Some(side)) => format!("{sign} {}", probability_text(side.probability)),
        (None, None) => String::new(),
    }
}

/// What a change of a state is, in words.
pub(crate) fn state_words(change: &Change<StateSide>) -> String {
    let (Some(old), Some(new)) = (&change.before, &change.after) else { return String::new() };
    let mut words = Vec::new();
    if old.name != new.name {
        let name = |side: &StateSide| side.name.clone().unwrap_or_else(|| "no name".to_owned());
        words.push(format!("{} → {}", name(old), name(new)));
    }
    if old.accepting != new.accepting {
        words.push(if new.accepting { "accepting now" } else { "not accepting any more" }.to_owned());
    } else if probability_text(old.final_probability) != probability_text(new.final_probability) {
        let (before, after) =
            (probability_text(old.final_probability), probability_text(new.final_probability));
        words.push(format!("ends {before} → {after}"));
    } else if old.end_count != new.end_count {
        words.push(format!("{} → {} ended here", old.end_count, new.end_count));
    }
    if old.completed != new.completed {
        words.push("completes other sub-goals".to_owned());
    }
    if words.is_empty() {
        words.push("weights".to_owned());
    }
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use goalgraph::edit::{Edit, Outcome};
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;

    use super::*;

    #[test]
    fn labels_say_what_became_of_a_probability() {
        let word = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let before = infer_words("Task", Semantics::default(), &[word(&["a"]), word(&["b"])]);
        let mut after = before.clone();
        let (state, outcome) = (StateId(0), Outcome::Transition(Symbol(0)));
        let locked = std::collections::BTreeSet::new();
        Edit::Reweight { state, outcome, probability: 0.25, locked }.apply(&mut after).unwrap();
        let label = |drawing: &Drawing| drawing.label(StateId(0), Symbol(0)).1;
        assert_eq!(label(&Drawing::of(&before, &after)), "0.50 → 0.25");
        assert_eq!(label(&Drawing::of(&before, &before)), "0.50");
    }
}
