//! The real program and the real server, on real files and sockets.

#![allow(clippy::unwrap_used)]

mod api;
mod check_and_export;
mod executor;
mod executor_session;
mod http;
mod infer;
mod killed;
mod plan;
mod relay;
mod schema;
mod serve;
mod store;
mod support;
