//! The automaton in the language of Graphviz.

use std::collections::BTreeSet;

use crate::layout::drawing::probability_text;
use crate::pdfa::{Probabilities, Semantics, State, StateId, Symbol, Transition};
use crate::specification::{Specification, SubGoal};

/// The automaton as a directed graph that `dot` draws, and that `AALpy` and petgraph's parser read.
///
/// Every state and transition is one line. For people there is a label; for programs there are attributes with ids and
/// exact numbers (as many digits as it takes to read the same number back):
///
/// - of the graph `name`, `semantics`, and the names of the sub-goals under their ids, in the order of the alphabet;
/// - of states `name` where an expert gave one, `completed` (ids of sub-goals), `accepting`, `end_count`, `end_weight`, `final_probability`;
/// - of transitions `symbol`, `probability`, `count`, `weight`.
///
/// The node `__start0` and the edge from it mark the initial state; accepting states are double circles. `AALpy` reads lines
/// with regular expressions and takes the first `label=` it finds: `mdp_label` stands first, so that
/// `load_automaton_from_file(.., "mdp")` gets symbols and probabilities. Names are written so that no line looks like another
/// kind of line to it.
///
/// # Complexity
///
/// O(Q · A + T) for Q states, T transitions and A sub-goals.
pub fn dot(specification: &Specification) -> String {
    let pdfa = &specification.pdfa;
    let probabilities = pdfa.probabilities(specification.semantics);
    let mut text = format!("digraph {} {{\n", quoted(&title(&specification.name)));
    text += "  rankdir=LR;\n  node [shape=circle];\n";
    text += &graph_lines(specification);
    text += "  __start0 [label=\"\" shape=\"none\"];\n";
    text = text + "  __start0 -> " + &pdfa.initial.to_string() + " [label=\"\"];\n";
    for (&id, state) in &pdfa.states {
        text += &state_line(specification, &probabilities, id, state);
    }
    for (source, symbol, transition) in pdfa.transitions() {
        text += &transition_line(specification, &probabilities, (source, symbol, transition));
    }
    text + "}\n"
}

/// What only programs read: names to the letter.
fn graph_lines(specification: &Specification) -> String {
    let semantics = match specification.semantics {
        Semantics::MaximumLikelihood => "maximum_likelihood",
        Semantics::Published => "published",
    };
    let mut text = format!("  name={};\n  semantics=\"{semantics}\";\n", exact(&specification.name));
    let line = |sub_goal: &SubGoal| format!("  {}={};\n", sub_goal.id, exact(&sub_goal.name));
    text.extend(specification.sub_goals.iter().map(line));
    text
}

fn state_line(
    specification: &Specification,
    probabilities: &Probabilities,
    id: StateId,
    state: &State,
) -> String {
    let names: Vec<String> = state.completed.iter().map(|&symbol| specification.name_of(symbol)).collect();
    let label = if names.is_empty() { id.to_string() } else { format!("{id}\n{}", names.join(", ")) };
    let shape = if state.accepting { "doublecircle" } else { "circle" };
    let name = state.name.as_ref().map_or_else(String::new, |name| format!(" name={}", exact(name)));
    format!(
        "  {id} [label={} shape=\"{shape}\"{name} completed=\"{}\" accepting=\"{}\" end_count=\"{}\" end_weight=\"{}\" \
         final_probability=\"{}\"];\n",
        quoted(&label),
        ids(&state.completed),
        state.accepting,
        state.end_count,
        state.end_weight,
        probabilities.end(id),
    )
}

fn transition_line(
    specification: &Specification,
    probabilities: &Probabilities,
    (source, symbol, transition): (StateId, Symbol, &Transition),
) -> String {
    let probability = probabilities.transition(source, symbol);
    let (target, count, weight) = (transition.target, transition.count, transition.weight);
    let name = specification.name_of(symbol);
    let label = format!("{name}\n{} ({count})", probability_text(probability));
    format!(
        "  {source} -> {target} [mdp_label=\"{symbol}:{probability}\" label={} symbol=\"{symbol}\" \
         probability=\"{probability}\" count=\"{count}\" weight=\"{weight}\"];\n",
        quoted(&label),
    )
}

fn ids(symbols: &BTreeSet<Symbol>) -> String {
    symbols.iter().map(Symbol::to_string).collect::<Vec<_>>().join(" ")
}

/// The name in a single line, not in the letters of the word by which `AALpy` knows a state's line.
fn title(name: &str) -> String {
    name.replace('\n', " ").replace("label", "Label")
}

/// `text` as a quoted string from which it can be read back to the letter: control characters are written as entities, and
/// so is the first letter of the word by which `AALpy` knows a state's line.
fn exact(text: &str) -> String {
    written(text, |control| format!("&#{};", u32::from(control))).replace("label", "&#108;abel")
}

/// `text` as a quoted string that Graphviz shows as it is, a line break as such; control characters are left out.
fn quoted(text: &str) -> String {
    written(text, |_| " ".to_owned())
}

/// `text` in quotes. What would start an HTML entity or look like an edge or the start node is written as an entity.
fn written(text: &str, control: impl Fn(char) -> String) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' => quoted += "&quot;",
            '\\' => quoted += "\\\\",
            '&' => quoted += "&amp;",
            '>' => quoted += "&gt;",
            '<' => quoted += "&lt;",
            '\n' => quoted += "\\n",
            other if other.is_control() => quoted += &control(other),
            other => quoted.push(other),
        }
    }
    quoted.replace("__start0", "__start&#48;") + "\""
}
