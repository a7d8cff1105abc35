//! What is seen. Every function takes values and emits actions; what it keeps is what somebody is typing, no more.

pub(crate) mod automaton;
pub(crate) mod benchmark;
pub(crate) mod chips;
pub(crate) mod demonstrations;
pub(crate) mod draft;
pub(crate) mod files;
pub(crate) mod filter;
pub(crate) mod graph;
pub(crate) mod inspector;
pub(crate) mod keeping;
pub(crate) mod menu;
pub(crate) mod overlay;
pub(crate) mod plot;
pub(crate) mod run;
pub(crate) mod search;
pub(crate) mod settings;
pub(crate) mod shell;
pub(crate) mod side;
pub(crate) mod simulate;
pub(crate) mod start;
pub(crate) mod sub_goals;
pub(crate) mod table;
pub(crate) mod text_pane;
pub(crate) mod tracks;
pub(crate) mod viewport;
pub(crate) mod words;
