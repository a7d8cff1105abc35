//! What is seen. Every function takes values and emits actions; none keeps state of its own.

pub(crate) mod automaton;
pub(crate) mod chips;
pub(crate) mod demonstrations;
pub(crate) mod files;
pub(crate) mod graph;
pub(crate) mod inspector;
pub(crate) mod overlay;
pub(crate) mod plot;
pub(crate) mod run;
pub(crate) mod settings;
pub(crate) mod shell;
pub(crate) mod start;
pub(crate) mod sub_goals;
pub(crate) mod table;
pub(crate) mod tracks;
pub(crate) mod viewport;
pub(crate) mod words;
