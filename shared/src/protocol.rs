//! What server, executors and browsers say to each other: one type on both ends.
//!
//! [`executor`] is the WebSocket protocol between the server and a robot, [`monitor`] the one between the server and a
//! page that watches runs, [`api`] the JSON below `/api/v1`.

pub mod api;
pub mod executor;
pub mod monitor;
mod role;
