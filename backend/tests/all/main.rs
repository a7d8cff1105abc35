//! The real program and the real server, on real files and sockets.

#![allow(clippy::unwrap_used)]

mod check_and_export;
mod infer;
mod plan;
mod relay;
mod schema;
mod serve;
mod store;
mod support;
