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
//! The modules stand in reading order; a module uses only those before it.

pub mod conformance;
pub mod dbscan;
pub mod demonstration;
pub mod difference;
pub mod distance;
pub mod dwell;
pub mod edit;
pub mod evidence;
pub mod execution;
pub mod export;
pub mod fix;
pub mod history;
pub mod import;
pub mod infer;
pub mod k_distance;
mod kd_tree;
pub mod language;
pub mod layout;
pub mod merge_candidates;
pub mod outage;
mod parallel;
pub mod parameters;
pub mod pdfa;
pub mod plan;
pub mod points;
pub mod preview;
pub mod protocol;
pub mod rest;
pub mod run;
pub mod sampling;
pub mod specification;
pub mod sub_goal;
pub mod subset;
pub mod versioned;
pub mod word;
