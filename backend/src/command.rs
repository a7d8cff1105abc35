//! The commands, one module each: its arguments, and `run`.

pub(crate) mod check;
pub(crate) mod executor;
pub(crate) mod export;
pub(crate) mod infer;
pub(crate) mod plan;
pub(crate) mod schema;
pub(crate) mod serve;
