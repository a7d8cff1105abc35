//! The real program and the real server, on real files and sockets.

#![allow(clippy::unwrap_used)]

mod api;
mod check_and_export;
mod http;
mod infer;
mod plan;
mod relay;
mod schema;
mod serve;
mod store;
mod support;
