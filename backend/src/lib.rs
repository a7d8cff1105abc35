//! The Goalgraph server: the app, embedded in the program, over HTTP on this computer.
//!
//! The command line in `main.rs` starts it with `goalgraph serve`; tests call [`server::app`]. [`executor`] is the other end of its
//! relay, a simulated robot; [`alphabet`] finds sub-goals by what people call them.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod alphabet;
pub mod executor;
pub mod server;
