//! The real program and the real server, on real files and sockets.

#![allow(clippy::unwrap_used)]

mod check_and_export;
mod executor;
mod executor_session;
mod infer;
mod plan;
mod schema;
mod serve;
mod support;
