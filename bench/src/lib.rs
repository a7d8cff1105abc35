//! What is measured: workloads made from seeds, the same natively and in the browser.
//!
//! - [`clouds`]: points to cluster
//! - [`recordings`]: demonstrations as CSV
//! - [`words`]: words to make an automaton of
//!
//! The program `goalgraph-bench` measures them and `cargo xtask bench` runs it.

pub mod clouds;
pub mod recordings;
pub mod words;

#[cfg(target_arch = "wasm32")]
mod browser;
