//! Instructions, where noise would drown a time.

use anyhow::Result;

use crate::Options;
use crate::count::{COUNTED, instructions};
use crate::report::{Report, figures};

pub(super) fn run(_: &Options, report: &mut Report) -> Result<()> {
    for counted in &COUNTED {
        let measured = match instructions(counted)? {
            Some(count) => format!("{} a {}", figures(count), counted.per),
            None => "not counted: valgrind is not installed".to_owned(),
        };
        report.row(counted.name, measured);
    }
    Ok(())
}
