//! The demonstrations that come with the app.

use anyhow::{Result, bail};

use crate::project::Project;

/// Writes `assets/samples/` again from the task simulations.
///
/// # Errors
///
/// Always, until the simulations are there.
pub(crate) fn regenerate(project: &Project) -> Result<()> {
    bail!(
        "{} cannot be written yet: the task simulations are not there",
        project.root.join("assets/samples").display()
    )
}
