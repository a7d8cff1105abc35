//! The Goalgraph engine: recorded demonstrations in, a probabilistic deterministic finite automaton (PDFA) out.
//!
//! ```text
//! bytes -import-> Demonstration -cluster-> SubGoal -word-> Word -infer-> Pdfa
//!                                                                         |
//!                          Specification {features, subsets, sub-goals, words, pdfa}
//!                                          |          |          |
//!                                       layout       plan      export
//! ```
//!
//! The method is *Learning Task Specifications from Demonstrations as Probabilistic Automata* (Baert, Leroux,
//! Simoens). Values go in, values come out: there are no files, sockets, clocks or threads here, so the same code
//! runs natively and as WebAssembly, and the same input gives the same bytes in both.
//!
//! The modules stand in groups in reading order; a module uses those of its own group and of groups before it.

// What everything is made of.
pub mod demonstration;
mod kd_tree;
mod parallel;
pub mod pdfa;
pub mod points;
pub mod specification;
pub mod versioned;

// Recordings in.
pub mod import;

// From demonstrations to words and automaton.
pub mod dbscan;
pub mod dwell;
pub mod infer;
pub mod k_distance;
pub mod parameters;
pub mod rest;
pub mod sub_goal;
pub mod subset;
pub mod word;

// What an automaton says.
pub mod conformance;
pub mod difference;
pub mod distance;
pub mod evidence;
pub mod language;
pub mod merge_candidates;
pub mod outage;
pub mod sampling;

// Changing it.
pub mod edit;
pub mod fix;
pub mod history;
pub mod preview;

// Drawing and handing it out.
pub mod export;
pub mod layout;

// Following it.
pub mod execution;
pub mod plan;
pub mod protocol;
pub mod run;
