//! The specification in the formats of other tools.

mod dot;
mod json;
mod svg;
#[cfg(test)]
mod tests;

use crate::specification::Specification;

pub use dot::dot;
pub use json::json;
pub use svg::svg;

/// A format to export to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExportFormat {
    /// The automaton in the language of Graphviz.
    Dot,
    /// The specification itself, as it is saved and approved.
    Json,
    /// A drawing of the automaton.
    Svg,
}

impl ExportFormat {
    /// All formats, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Dot, Self::Json, Self::Svg];

    /// What people call it, and the command line too: `dot`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dot => "dot",
            Self::Json => "json",
            Self::Svg => "svg",
        }
    }

    /// The format called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }

    /// What it is good for, in a few words.
    pub fn description(self) -> &'static str {
        match self {
            Self::Dot => "the automaton for Graphviz, AALpy and petgraph",
            Self::Json => "the specification file",
            Self::Svg => "a drawing of the automaton",
        }
    }

    /// End of a file's name, without the leading point.
    pub fn file_extension(self) -> &'static str {
        match self {
            Self::Dot => "dot",
            Self::Json => "goalgraph.json",
            Self::Svg => "svg",
        }
    }

    /// Media type, without parameters; all formats are UTF-8.
    pub fn mime_type(self) -> &'static str {
        match self {
            Self::Dot => "text/vnd.graphviz",
            Self::Json => "application/json",
            Self::Svg => "image/svg+xml",
        }
    }
}

/// `specification` as a text in `format`. Equal specifications give equal bytes.
pub fn export(specification: &Specification, format: ExportFormat) -> String {
    match format {
        ExportFormat::Dot => dot(specification),
        ExportFormat::Json => json(specification),
        ExportFormat::Svg => svg(specification),
    }
}
