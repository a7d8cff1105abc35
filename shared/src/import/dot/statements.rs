//! Statements: what a graph says about itself, its nodes and its edges.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::DotError;
use super::tokens::{Kind, Token};

/// Attributes by name, each with its line.
pub(super) type Attributes = BTreeMap<String, Value>;

/// What is given for an attribute.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Value {
    pub(super) line: usize,
    pub(super) text: String,
}

/// A node with what one statement says about it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) line: usize,
    pub(super) id: String,
    pub(super) attributes: Attributes,
}

/// An edge.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Edge {
    pub(super) line: usize,
    pub(super) source: String,
    pub(super) target: String,
    pub(super) attributes: Rc<Attributes>,
}

/// All statements of a graph, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Graph {
    /// What stands after `digraph`.
    pub(super) id: String,
    /// Attributes of the graph, the later of two with one name.
    pub(super) attributes: Vec<(String, Value)>,
    pub(super) nodes: Vec<Node>,
    pub(super) edges: Vec<Edge>,
}

/// Reads `strict? digraph id? { statement* }`.
pub(super) fn graph(tokens: &[Token]) -> Result<Graph, DotError> {
    let mut reader = Reader { tokens, at: 0 };
    let mut graph = Graph::default();
    if reader.peek().is_some_and(|token| is_word(token, "strict")) {
        reader.at += 1;
    }
    let digraph = reader.expect("digraph")?;
    if !is_word(digraph, "digraph") {
        let message = format!("{} is no directed graph; expected digraph", digraph.shown());
        return Err(DotError::at(digraph.line, message));
    }
    if let Some(id) = reader.id() {
        graph.id = id.text;
    }
    reader.sign('{')?;
    loop {
        let token = reader.expect("a statement or }")?;
        match &token.kind {
            Kind::Sign('}') => break,
            Kind::Sign(';') => {}
            _ => {
                reader.at -= 1;
                reader.statement(&mut graph)?;
            }
        }
    }
    match reader.peek() {
        Some(more) => {
            let message = format!("{} follows the graph; expected the end of the file", more.shown());
            Err(DotError::at(more.line, message))
        }
        None => Ok(graph),
    }
}

struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
}

impl<'a> Reader<'a> {
    fn peek(&self) -> Option<&'a Token> {
        self.tokens.get(self.at)
    }

    fn expect(&mut self, what: &str) -> Result<&'a Token, DotError> {
        let token = self.peek().ok_or_else(|| match self.tokens.last() {
            Some(last) => DotError::at(last.line, format!("the file ends here; expected {what}")),
            None => DotError::whole(format!("the file is empty; expected {what}")),
        })?;
        self.at += 1;
        Ok(token)
    }

    /// Goes past the sign when it is next.
    fn takes(&mut self, sign: char) -> bool {
        let is_next = self.peek().is_some_and(|token| token.kind == Kind::Sign(sign));
        self.at += usize::from(is_next);
        is_next
    }

    fn sign(&mut self, sign: char) -> Result<(), DotError> {
        let token = self.expect(&sign.to_string())?;
        if token.kind == Kind::Sign(sign) {
            return Ok(());
        }
        Err(DotError::at(token.line, format!("{} cannot stand here; expected {sign}", token.shown())))
    }

    /// The id or text that is next; texts joined by + are one.
    fn id(&mut self) -> Option<Value> {
        let token = self.peek()?;
        let mut text = match &token.kind {
            Kind::Id(text) | Kind::Quoted(text) => text.clone(),
            _ => return None,
        };
        self.at += 1;
        while let (Some(plus), Some(Token { kind: Kind::Quoted(more), .. })) =
            (self.peek(), self.tokens.get(self.at + 1))
            && plus.kind == Kind::Sign('+')
        {
            text += more;
            self.at += 2;
        }
        Some(Value { line: token.line, text })
    }

    fn statement(&mut self, graph: &mut Graph) -> Result<(), DotError> {
        let token = self.expect("a statement")?;
        self.at -= 1;
        let Some(first) = self.id() else {
            let message = format!("{} starts no statement; expected an id", token.shown());
            return Err(DotError::at(token.line, message));
        };
        let line = first.line;
        let is_bare = matches!(token.kind, Kind::Id(_));
        if is_bare && first.text.eq_ignore_ascii_case("subgraph") {
            return Err(DotError::at(line, "a subgraph; expected states and transitions only"));
        }
        if self.takes('=') {
            let value = self.value(&first.text)?;
            graph.attributes.push((first.text, value));
            return Ok(());
        }
        if is_bare && ["node", "edge", "graph"].iter().any(|word| first.text.eq_ignore_ascii_case(word)) {
            let attributes = self.attributes()?;
            if first.text.eq_ignore_ascii_case("graph") {
                graph.attributes.extend(attributes);
            }
            return Ok(());
        }
        let mut ends = vec![first.text];
        while self.peek().is_some_and(|token| token.kind == Kind::Arrow) {
            self.at += 1;
            let next = self.expect("an id after ->")?;
            self.at -= 1;
            let Some(end) = self.id() else {
                let message = format!("{} is no node; expected an id after ->", next.shown());
                return Err(DotError::at(next.line, message));
            };
            ends.push(end.text);
        }
        let attributes = self.attributes()?;
        if let [id] = ends.as_slice() {
            graph.nodes.push(Node { line, id: id.clone(), attributes });
            return Ok(());
        }
        let attributes = Rc::new(attributes);
        for pair in ends.windows(2) {
            let (source, target) = (pair[0].clone(), pair[1].clone());
            graph.edges.push(Edge { line, source, target, attributes: Rc::clone(&attributes) });
        }
        Ok(())
    }

    /// Reads `[name=value, ..]`, as often as it is there.
    fn attributes(&mut self) -> Result<Attributes, DotError> {
        let mut attributes = Attributes::new();
        while self.takes('[') {
            while !self.takes(']') {
                if self.takes(',') || self.takes(';') {
                    continue;
                }
                let token = self.expect("an attribute or ]")?;
                self.at -= 1;
                let Some(name) = self.id() else {
                    let message = format!("{} is no attribute; expected a name or ]", token.shown());
                    return Err(DotError::at(token.line, message));
                };
                self.sign('=')?;
                let value = self.value(&name.text)?;
                attributes.insert(name.text, value);
            }
        }
        Ok(attributes)
    }

    fn value(&mut self, name: &str) -> Result<Value, DotError> {
        let token = self.expect("a value")?;
        self.at -= 1;
        self.id().ok_or_else(|| {
            let name = super::tokens::shortened(name);
            DotError::at(
                token.line,
                format!("{} is no value of {name}; expected an id or text", token.shown()),
            )
        })
    }
}

fn is_word(token: &Token, word: &str) -> bool {
    matches!(&token.kind, Kind::Id(text) if text.eq_ignore_ascii_case(word))
}
