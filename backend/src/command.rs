//! The commands, one module each: its arguments, and `run`.

pub(crate) mod backup;
pub(crate) mod check;
pub(crate) mod executor;
pub(crate) mod export;
pub(crate) mod infer;
pub(crate) mod plan;
pub(crate) mod schema;
pub(crate) mod serve;
pub(crate) mod store_arguments;
pub(crate) mod token;
pub(crate) mod verify;
