//! The app in the browser: demonstrations dropped in, sub-goals found, the automaton drawn.
//!
//! ```text
//! page                                       worker
//! gesture -Action-> update -ToWorker------>  read, infer, lay out
//!             |                                       |
//!           Model  <-----------------FromWorker-------+
//!             |
//!          Derived -> views
//! ```
//!
//! The [`page`] and the [`worker`] are two programs that share the [`protocol`]. In the page, signals hold ground state
//! only (`model`); whatever follows from it is a memo (`derived`); whatever changes it is an action (`update`); whatever
//! a person can do is a command (`commands`).

#[cfg(feature = "page")]
pub mod page;
mod program;
pub mod protocol;
pub mod worker;
