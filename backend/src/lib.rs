//! The Goalgraph server: the app, embedded in the program, over HTTP on this computer.
//!
//! The command line in `main.rs` starts it with `goalgraph serve`; tests call [`server::app`]. [`store`] keeps what is
//! saved, [`relay`] takes what is approved to executors and shows what they make of it, [`token`] tells who may do what.

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod digest;
pub mod relay;
pub mod server;
pub mod store;
pub mod token;
