//! The Goalgraph server: the app, embedded in the program, over HTTP on this computer.
//!
//! The command line in `main.rs` starts it with `goalgraph serve`; tests call [`server::app`].

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod server;
