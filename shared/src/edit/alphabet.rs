//! Names and colors of sub-goals.

use super::{COLORS, EditError};
use crate::pdfa::Symbol;
use crate::specification::{Specification, SubGoal};

/// The sub-goal `symbol`.
pub(super) fn sub_goal(specification: &mut Specification, symbol: Symbol) -> Result<&mut SubGoal, EditError> {
    let found = specification.sub_goals.iter_mut().find(|sub_goal| sub_goal.id == symbol);
    found.ok_or(EditError::NoSubGoal(symbol))
}

/// That `symbol` is in the alphabet.
pub(super) fn known(specification: &Specification, symbol: Symbol) -> Result<(), EditError> {
    specification.sub_goal(symbol).map(|_| ()).ok_or(EditError::NoSubGoal(symbol))
}

/// Gives `symbol` a color of the palette, or none.
pub(super) fn recolor(
    specification: &mut Specification,
    symbol: Symbol,
    color: Option<u8>,
) -> Result<(), EditError> {
    if let Some(color) = color.filter(|&color| color >= COLORS) {
        return Err(EditError::Color(color));
    }
    sub_goal(specification, symbol)?.color = color;
    Ok(())
}
