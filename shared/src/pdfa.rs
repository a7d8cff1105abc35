//! The probabilistic deterministic finite automaton, and the two readings of its probabilities.

mod from_words;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Identity of a state, written `q3`. Never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StateId(pub u32);

/// Identity of a sub-goal and the symbol that stands for it in words, written `g3`. Never reused.
///
/// The order of the alphabet is the order of the sub-goals in the specification, which the inference numbers upwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbol(pub u32);

/// Why a text is no id: it must be a letter and a number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{text:?} is no id; expected {letter} and a number, such as {letter}0")]
pub struct ParseIdError {
    text: String,
    letter: char,
}

fn parse_id(text: &str, letter: char) -> Result<u32, ParseIdError> {
    let digits = text.strip_prefix(letter).filter(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()));
    let number = digits.filter(|digits| *digits == "0" || !digits.starts_with('0')).map(str::parse);
    match number {
        Some(Ok(number)) => Ok(number),
        _ => Err(ParseIdError { text: text.to_owned(), letter }),
    }
}

#[cfg(feature = "schema")]
macro_rules! id_schema {
    ($id:ident, $name:literal, $pattern:literal) => {
        impl schemars::JsonSchema for $id {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                $name.into()
            }

            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                schemars::json_schema!({ "type": "string", "pattern": $pattern })
            }
        }
    };
}

#[cfg(feature = "schema")]
id_schema!(StateId, "StateId", "^q(0|[1-9][0-9]*)$");
#[cfg(feature = "schema")]
id_schema!(Symbol, "Symbol", "^g(0|[1-9][0-9]*)$");

macro_rules! id_text {
    ($id:ident, $letter:literal) => {
        impl fmt::Display for $id {
            fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(formatter, concat!($letter, "{}"), self.0)
            }
        }

        impl FromStr for $id {
            type Err = ParseIdError;

            fn from_str(text: &str) -> Result<Self, ParseIdError> {
                parse_id(text, $letter).map(Self)
            }
        }

        impl Serialize for $id {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        impl<'de> Deserialize<'de> for $id {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let text = std::borrow::Cow::<'de, str>::deserialize(deserializer)?;
                text.parse().map_err(serde::de::Error::custom)
            }
        }
    };
}

id_text!(StateId, 'q');
id_text!(Symbol, 'g');

/// The sub-goals that one demonstration completed, in order.
pub type Word = Vec<Symbol>;

/// A way from one state to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// Where it leads.
    pub target: StateId,
    /// How many words took it: evidence, never edited.
    pub count: u64,
    /// What decides its probability; equal to `count` until an expert reweights.
    pub weight: f64,
}

/// A set of completed sub-goals, with what may come next.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct State {
    /// What an expert calls it.
    pub name: Option<String>,
    /// The sub-goals that are completed here.
    pub completed: BTreeSet<Symbol>,
    /// Whether the task may end here.
    pub accepting: bool,
    /// How many words ended here: evidence, never edited.
    pub end_count: u64,
    /// What decides the final probability; equal to `end_count` until an expert reweights.
    pub end_weight: f64,
    /// The ways out, one per symbol: the automaton is deterministic.
    pub transitions: BTreeMap<Symbol, Transition>,
}

/// A probabilistic deterministic finite automaton over sub-goals.
///
/// Every transition leads to a state that exists, weights are finite and not negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Pdfa {
    /// Where every word starts.
    pub initial: StateId,
    /// All states.
    pub states: BTreeMap<StateId, State>,
}

/// How weights are read as probabilities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Semantics {
    /// A transition has weight / (sum of outgoing weights + end weight), the final probability is end weight / the same
    /// sum: a distribution over words.
    #[default]
    MaximumLikelihood,
    /// Equations 2 and 3 of the paper: a transition has weight / sum of outgoing weights, an accepting state has inflow /
    /// total inflow of all accepting states. With several accepting states no distribution over words.
    Published,
}

/// The probabilities of an automaton under one [`Semantics`].
#[derive(Clone, Debug, PartialEq)]
pub struct Probabilities {
    transitions: BTreeMap<(StateId, Symbol), f64>,
    finals: BTreeMap<StateId, f64>,
}

impl Probabilities {
    /// Probability of leaving `source` by `symbol`; zero when there is no such transition.
    pub fn transition(&self, source: StateId, symbol: Symbol) -> f64 {
        self.transitions.get(&(source, symbol)).copied().unwrap_or(0.0)
    }

    /// Probability of ending in `state`; zero when there is no such state or it is not accepting.
    pub fn end(&self, state: StateId) -> f64 {
        self.finals.get(&state).copied().unwrap_or(0.0)
    }
}

impl Pdfa {
    /// The transition by `symbol` out of `source`.
    pub fn transition(&self, source: StateId, symbol: Symbol) -> Option<&Transition> {
        self.states.get(&source)?.transitions.get(&symbol)
    }

    /// All transitions as (source, symbol, transition), ordered by source and symbol.
    pub fn transitions(&self) -> impl Iterator<Item = (StateId, Symbol, &Transition)> {
        self.states.iter().flat_map(|(&source, state)| {
            state.transitions.iter().map(move |(&symbol, transition)| (source, symbol, transition))
        })
    }

    /// The probabilities of all transitions and accepting states under `semantics`.
    ///
    /// A state whose weights are all zero has probability zero everywhere.
    ///
    /// # Complexity
    ///
    /// O((Q + T) log T) for Q states and T transitions.
    pub fn probabilities(&self, semantics: Semantics) -> Probabilities {
        match semantics {
            Semantics::MaximumLikelihood => self.maximum_likelihood(),
            Semantics::Published => self.published(),
        }
    }

    fn maximum_likelihood(&self) -> Probabilities {
        let mut probabilities = Probabilities { transitions: BTreeMap::new(), finals: BTreeMap::new() };
        for (&id, state) in &self.states {
            let end_weight = if state.accepting { state.end_weight } else { 0.0 };
            let total = outgoing_weight(state) + end_weight;
            for (&symbol, transition) in &state.transitions {
                probabilities.transitions.insert((id, symbol), share(transition.weight, total));
            }
            if state.accepting {
                probabilities.finals.insert(id, share(end_weight, total));
            }
        }
        probabilities
    }

    /// Equations 2 and 3 of the paper.
    fn published(&self) -> Probabilities {
        let mut probabilities = Probabilities { transitions: BTreeMap::new(), finals: BTreeMap::new() };
        let mut inflow: BTreeMap<StateId, f64> = BTreeMap::new();
        for (&id, state) in &self.states {
            let total = outgoing_weight(state);
            for (&symbol, transition) in &state.transitions {
                probabilities.transitions.insert((id, symbol), share(transition.weight, total));
                *inflow.entry(transition.target).or_default() += transition.weight;
            }
        }
        let accepting: Vec<StateId> =
            self.states.iter().filter(|(_, state)| state.accepting).map(|(&id, _)| id).collect();
        let inflow_of = |id: &StateId| inflow.get(id).copied().unwrap_or(0.0);
        let total: f64 = accepting.iter().map(inflow_of).sum();
        for id in &accepting {
            let alone = accepting.len() == 1;
            probabilities.finals.insert(*id, if alone { 1.0 } else { share(inflow_of(id), total) });
        }
        probabilities
    }

    /// Probability of `word` under `probabilities`; zero when the automaton does not accept it.
    ///
    /// # Complexity
    ///
    /// O(n log T) for a word of n symbols and T transitions.
    pub fn word_probability(&self, word: &[Symbol], probabilities: &Probabilities) -> f64 {
        let mut state = self.initial;
        let mut probability = 1.0;
        for &symbol in word {
            let Some(transition) = self.transition(state, symbol) else {
                return 0.0;
            };
            probability *= probabilities.transition(state, symbol);
            state = transition.target;
        }
        probability * probabilities.end(state)
    }
}

fn outgoing_weight(state: &State) -> f64 {
    state.transitions.values().map(|transition| transition.weight).sum()
}

fn share(weight: f64, total: f64) -> f64 {
    if total > 0.0 { weight / total } else { 0.0 }
}
