//! From nodes and edges to an automaton with its alphabet.

use std::collections::{BTreeMap, BTreeSet};
use std::str::FromStr;

use super::DotError;
use super::statements::{Attributes, Edge, Graph, Node, Value};
use super::tokens::shortened;
use crate::pdfa::{Pdfa, Semantics, State, StateId, Symbol, Transition};
use crate::specification::{Specification, SubGoal};

/// The node that marks the initial state.
const START: &str = "__start0";

/// The specification that a graph describes.
pub(super) fn specification(graph: &Graph) -> Result<Specification, DotError> {
    let mut reading = Reading::default();
    for node in graph.nodes.iter().filter(|node| node.id != START) {
        reading.node(node)?;
    }
    for edge in &graph.edges {
        reading.edge(edge)?;
    }
    let initial = reading.initial.ok_or_else(|| {
        DotError::whole(format!("no state is the initial one; expected an edge from {START} to it"))
    })?;
    let (mut name, mut semantics) = (graph.id.clone(), Semantics::default());
    let mut names: Vec<(Symbol, String)> = Vec::new();
    for (attribute, value) in &graph.attributes {
        match attribute.as_str() {
            "name" => name.clone_from(&value.text),
            "semantics" => semantics = semantics_of(value)?,
            other => {
                if let Ok(symbol) = other.parse() {
                    names.push((symbol, value.text.clone()));
                }
            }
        }
    }
    let sub_goals = reading.alphabet(names);
    let states = reading.states();
    let pdfa = Pdfa { initial, states };
    let (features, subsets, demonstrations) = (Vec::new(), Vec::new(), Vec::new());
    Ok(Specification { name, semantics, features, subsets, sub_goals, pdfa, demonstrations })
}

fn semantics_of(value: &Value) -> Result<Semantics, DotError> {
    match value.text.as_str() {
        "maximum_likelihood" => Ok(Semantics::MaximumLikelihood),
        "published" => Ok(Semantics::Published),
        other => {
            let message =
                format!("{} is no semantics; expected maximum_likelihood or published", shortened(other));
            Err(DotError::at(value.line, message))
        }
    }
}

/// What may be known about how often an outcome happens.
#[derive(Clone, Copy, Debug, Default)]
struct Odds {
    count: Option<u64>,
    weight: Option<f64>,
    probability: Option<f64>,
}

/// A state as far as it is read.
#[derive(Default)]
struct Draft {
    name: Option<String>,
    completed: BTreeSet<Symbol>,
    /// How often words end, where they may.
    end: Option<Odds>,
    end_count: u64,
    ways: BTreeMap<Symbol, (StateId, Odds)>,
}

#[derive(Default)]
struct Reading {
    initial: Option<StateId>,
    drafts: BTreeMap<StateId, Draft>,
    described: BTreeSet<StateId>,
    /// Names that labels of transitions give, for sub-goals that have no other.
    labels: BTreeMap<Symbol, Option<String>>,
}

impl Reading {
    fn node(&mut self, node: &Node) -> Result<(), DotError> {
        let id: StateId = id(node.line, &node.id)?;
        if !self.described.insert(id) {
            return Err(DotError::at(
                node.line,
                format!("{id} is described twice; expected each state once"),
            ));
        }
        let draft = self.drafts.entry(id).or_default();
        let attributes = &node.attributes;
        draft.name = attributes.get("name").map(|name| name.text.clone());
        if let Some(completed) = attributes.get("completed") {
            for symbol in completed.text.split_whitespace() {
                let symbol = self::id(completed.line, symbol)?;
                draft.completed.insert(symbol);
                self.labels.entry(symbol).or_default();
            }
        }
        let odds = Odds {
            count: number(attributes, "end_count")?,
            weight: weight(attributes, "end_weight")?,
            probability: weight(attributes, "final_probability")?,
        };
        draft.end_count = odds.count.unwrap_or(0);
        draft.end = is_accepting(attributes)?.then_some(odds);
        Ok(())
    }

    fn edge(&mut self, edge: &Edge) -> Result<(), DotError> {
        let target: StateId = id(edge.line, &edge.target)?;
        self.drafts.entry(target).or_default();
        if edge.source == START {
            return match self.initial.replace(target) {
                Some(other) if other != target => {
                    let message =
                        format!("{target} is initial, but so is {other}; expected one initial state");
                    Err(DotError::at(edge.line, message))
                }
                _ => Ok(()),
            };
        }
        let source: StateId = id(edge.line, &edge.source)?;
        let Some(symbol) = edge.attributes.get("symbol") else {
            let message = format!(
                "the edge from {source} to {target} has no symbol; expected symbol=\"g0\" or the like"
            );
            return Err(DotError::at(edge.line, message));
        };
        let symbol: Symbol = id(symbol.line, &symbol.text)?;
        let odds = Odds {
            count: number(&edge.attributes, "count")?,
            weight: weight(&edge.attributes, "weight")?,
            probability: weight(&edge.attributes, "probability")?,
        };
        let label = edge.attributes.get("label").and_then(|label| label.text.lines().next());
        let name = self.labels.entry(symbol).or_default();
        *name = name.take().or_else(|| label.filter(|label| !label.trim().is_empty()).map(str::to_owned));
        let ways = &mut self.drafts.entry(source).or_default().ways;
        if ways.insert(symbol, (target, odds)).is_some() {
            let message =
                format!("a second edge from {source} has the symbol {symbol}; expected at most one");
            return Err(DotError::at(edge.line, message));
        }
        Ok(())
    }

    /// The sub-goals in the order in which they are named, then the others by their ids.
    fn alphabet(&mut self, names: Vec<(Symbol, String)>) -> Vec<SubGoal> {
        let sub_goal = |id: Symbol, name: String| SubGoal {
            id,
            name,
            ball: None,
            frames: 0,
            demonstrations: 0,
            color: None,
        };
        let mut known = BTreeSet::new();
        let mut sub_goals: Vec<SubGoal> = Vec::new();
        for (id, name) in names {
            self.labels.remove(&id);
            if known.insert(id) {
                sub_goals.push(sub_goal(id, name));
            }
        }
        let labels = std::mem::take(&mut self.labels);
        sub_goals.extend(
            labels.into_iter().map(|(id, name)| sub_goal(id, name.unwrap_or_else(|| id.to_string()))),
        );
        sub_goals
    }

    fn states(self) -> BTreeMap<StateId, State> {
        self.drafts.into_iter().map(|(id, draft)| (id, draft.state())).collect()
    }
}

impl Draft {
    fn state(self) -> State {
        let odds = || self.ways.values().map(|(_, odds)| odds).chain(&self.end);
        let all = |has: fn(&Odds) -> bool| odds().all(has);
        let weight_of: fn(&Odds) -> f64 = match () {
            () if all(|odds| odds.weight.is_some()) => |odds| odds.weight.unwrap_or_default(),
            () if all(|odds| odds.probability.is_some()) => |odds| odds.probability.unwrap_or_default(),
            () if all(|odds| odds.count.is_some()) => |odds| odds.count.unwrap_or_default() as f64,
            () => |_| 1.0,
        };
        let transition = |(symbol, (target, odds)): (&Symbol, &(StateId, Odds))| {
            let (count, weight) = (odds.count.unwrap_or(0), weight_of(odds));
            (*symbol, Transition { target: *target, count, weight })
        };
        State {
            transitions: self.ways.iter().map(transition).collect(),
            accepting: self.end.is_some(),
            end_weight: self.end.as_ref().map_or(0.0, weight_of),
            end_count: self.end_count,
            name: self.name,
            completed: self.completed,
        }
    }
}

fn id<T: FromStr>(line: usize, text: &str) -> Result<T, DotError>
where
    T::Err: std::fmt::Display,
{
    text.parse().map_err(|error: T::Err| {
        let shown = if text.chars().count() > 40 { shortened(text) } else { error.to_string() };
        DotError::at(line, if shown.contains("expected") { shown } else { format!("{shown} is no id") })
    })
}

fn is_accepting(attributes: &Attributes) -> Result<bool, DotError> {
    match attributes.get("accepting") {
        None => Ok(attributes.get("shape").is_some_and(|shape| shape.text == "doublecircle")),
        Some(value) => value.text.parse().map_err(|_| {
            let message = format!("accepting is {}; expected true or false", shortened(&value.text));
            DotError::at(value.line, message)
        }),
    }
}

fn number(attributes: &Attributes, name: &str) -> Result<Option<u64>, DotError> {
    let read = |value: &Value| {
        value.text.parse().map_err(|_| {
            let message =
                format!("{name} is {}; expected a whole number not below 0", shortened(&value.text));
            DotError::at(value.line, message)
        })
    };
    attributes.get(name).map(read).transpose()
}

fn weight(attributes: &Attributes, name: &str) -> Result<Option<f64>, DotError> {
    let read = |value: &Value| {
        let number = value.text.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
        number.ok_or_else(|| {
            let message =
                format!("{name} is {}; expected a finite number not below 0", shortened(&value.text));
            DotError::at(value.line, message)
        })
    };
    attributes.get(name).map(read).transpose()
}
