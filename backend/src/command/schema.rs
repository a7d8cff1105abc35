//! `goalgraph schema`: the JSON Schemas of what Goalgraph writes and says.

use clap::{Args, ValueEnum};
use goalgraph::{protocol, specification};

use crate::failure::Failure;
use crate::output;

/// Arguments of `goalgraph schema`.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Of what
    #[arg(value_enum, default_value_t)]
    of: Format,
}

/// What has a schema.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum Format {
    /// The specification file
    #[default]
    Specification,
    /// The messages between the server and an executor
    Executor,
}

/// Prints the schema.
///
/// # Errors
///
/// When standard output cannot be written.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    output::print(&match arguments.of {
        Format::Specification => specification::json_schema(),
        Format::Executor => protocol::executor::json_schema(),
    })
}
