//! The real program and the real server, on real files and sockets.

#![allow(clippy::unwrap_used)]

mod api;
mod check_and_export;
mod encrypted;
mod executor;
mod executor_session;
mod http;
mod infer;
mod killed;
mod plan;
mod program;
mod relay;
mod schema;
mod serve;
mod stopped;
mod store;
mod support;
