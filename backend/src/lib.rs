//! The Goalgraph server: the app, embedded in the program, the API, and the relay between approved specifications and
//! robots.
//!
//! Modules in reading order: [`clock`], [`digest`] and [`alphabet`], the smallest things; [`token`] and [`store`], what
//! is kept; [`relay`], the sockets of executors and of those who watch; [`executor`], the other end of such a socket: a
//! simulated robot; [`access`], who may ask; [`api`], the JSON below `/api/v1`; [`server`], all of it over HTTP. The
//! command line in `main.rs` starts it with `goalgraph serve`.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod access;
pub mod alphabet;
pub mod api;
pub mod clock;
pub mod digest;
pub mod executor;
pub mod relay;
pub mod server;
pub mod store;
pub mod token;
