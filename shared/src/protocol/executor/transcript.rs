//! What was said on a connection, line by line: the form of docs/executor-session.jsonl.

use serde::{Deserialize, Serialize};

use super::{FromExecutor, ToExecutor};

/// A message of `goalgraph.executor.v1`, with who says it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "from", content = "message", rename_all = "snake_case", deny_unknown_fields)]
pub enum Spoken {
    /// The executor says it.
    Executor(FromExecutor),
    /// The server says it.
    Server(ToExecutor),
}

/// The JSON Schema (draft 2020-12) of a line of a transcript. The messages alone are its definitions `FromExecutor` and
/// `ToExecutor`.
#[cfg(feature = "schema")]
pub fn json_schema() -> String {
    let schema = schemars::schema_for!(Spoken);
    let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
    text.push('\n');
    text
}
