//! From DOT, as [`export::dot`](crate::export::dot) writes it, back to a specification.
//!
//! ```text
//! text -tokens-> tokens -statements-> graph attributes, nodes, edges -automaton-> specification
//! ```
//!
//! This is a subset of Graphviz's language: one directed graph of attributes, nodes and edges, without subgraphs, ports and
//! HTML. Whatever is beyond it is refused with its line.

mod automaton;
mod statements;
mod tokens;

use thiserror::Error;

use crate::specification::Specification;

/// Why a text is no automaton in DOT. Its text is one sentence with the line, where there is one.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}{message}", line.map(|line| format!("line {line}: ")).unwrap_or_default())]
pub struct DotError {
    /// The line, from 1; none when it is about the whole file.
    pub line: Option<usize>,
    /// What was found and what was expected.
    pub message: String,
}

impl DotError {
    /// Something is wrong at `line`, from 1.
    fn at(line: usize, message: impl Into<String>) -> Self {
        Self { line: Some(line), message: message.into() }
    }

    /// Something is wrong with the file as a whole.
    fn whole(message: impl Into<String>) -> Self {
        Self { line: None, message: message.into() }
    }
}

/// Reads an automaton from DOT: its structure, counts and weights, with the names of sub-goals and states.
///
/// Nodes are states, called `q0`, `q1` and so on; the edge from `__start0` leads to the initial one. Attributes of a node that
/// are read: `name`, `completed`, `accepting` (or the shape `doublecircle`), `end_count`, `end_weight` and
/// `final_probability`. Of an edge: `symbol`, which it must have, `count`, `weight`, `probability`, and the first line of
/// `label` for the name of a sub-goal that has no other. Of the graph: `name`, `semantics`, and the names of sub-goals under
/// their ids. Where the outcomes of a state do not all have weights, their probabilities are the weights, or else their
/// counts, or else 1.
///
/// There are no places and demonstrations in DOT, so the specification has none.
///
/// ```
/// use goalgraph::import::dot::read_dot;
///
/// let text = r#"digraph {
///   __start0 -> q0;
///   q0 -> q1 [symbol="g0" label="red" count="3"];
///   q1 [shape="doublecircle" end_count="3"];
/// }"#;
/// let specification = read_dot(text)?;
/// assert_eq!(specification.sub_goals[0].name, "red");
///
/// let error = read_dot("digraph {\n  q0 -> ;\n}").unwrap_err();
/// assert_eq!(error.to_string(), "line 2: \";\" is no node; expected an id after ->");
/// # Ok::<(), goalgraph::import::dot::DotError>(())
/// ```
///
/// # Errors
///
/// When the text is no directed graph in the subset above, says a thing twice, or breaks an invariant of a specification.
///
/// # Complexity
///
/// O(n log n) for n bytes.
pub fn read_dot(text: &str) -> Result<Specification, DotError> {
    let tokens = tokens::tokens(text)?;
    let graph = statements::graph(&tokens)?;
    let specification = automaton::specification(&graph)?;
    // What a file must keep, this must keep, too.
    Specification::from_json(&specification.to_json()).map_err(|error| DotError::whole(error.to_string()))
}
