//! `goalgraph export`: a specification in the format of another tool.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use goalgraph::export::{ExportFormat, export};

use crate::failure::Failure;
use crate::{input, output};

/// Arguments of `goalgraph export`.
#[derive(Args)]
pub(crate) struct Arguments {
    /// The specification; - is standard input
    #[arg(value_name = "SPEC")]
    specification: PathBuf,
    /// The format to write
    #[arg(long, value_parser = format_parser())]
    format: ExportFormat,
    /// The file to write; - is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

/// The engine's formats, by their names.
fn format_parser() -> impl TypedValueParser<Value = ExportFormat> {
    let value = |format: ExportFormat| PossibleValue::new(format.name()).help(format.description());
    let format = |name: String| ExportFormat::from_name(&name).ok_or("there is no such format");
    PossibleValuesParser::new(ExportFormat::ALL.map(value)).try_map(format)
}

/// Writes the specification in another format.
///
/// # Errors
///
/// When the specification cannot be read, or the file cannot be written.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let specification = input::read_specification(&arguments.specification)?;
    output::refuse_impossible(&arguments.output)?;
    output::write(&arguments.output, &export(&specification, arguments.format))
}
