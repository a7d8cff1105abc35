//! `goalgraph schema`: the JSON Schema of the specification file.

use goalgraph::specification::json_schema;

use crate::failure::Failure;
use crate::output;

/// Prints the schema.
///
/// # Errors
///
/// When standard output cannot be written.
pub(crate) fn run() -> Result<(), Failure> {
    output::print(&json_schema())
}
