//! Curves and arrow heads as the `d` of SVG paths.

use std::fmt::Write;

use goalgraph::layout::{ArrowHead, CubicBezier, Point, StartArrow};

/// Half the width of an arrow head at its base.
const ARROW_HALF_WIDTH: f64 = 4.0;

/// The line of a transition.
pub(crate) fn shaft(curves: &[CubicBezier]) -> String {
    let mut path = String::new();
    for (index, CubicBezier { start, control_1, control_2, end }) in curves.iter().enumerate() {
        if index == 0 {
            // Writing to a string cannot fail.
            let _ = write!(path, "M{:.1} {:.1}", start.x, start.y);
        }
        let _ = write!(
            path,
            "C{:.1} {:.1} {:.1} {:.1} {:.1} {:.1}",
            control_1.x, control_1.y, control_2.x, control_2.y, end.x, end.y
        );
    }
    path
}

/// The arrow from nowhere to the initial state.
pub(crate) fn start(start: &StartArrow) -> String {
    let base = start.arrow.base();
    format!("M{:.1} {:.1}L{:.1} {:.1}", start.from.x, start.from.y, base.x, base.y)
}

/// The head of an arrow.
pub(crate) fn head(arrow: &ArrowHead) -> String {
    let ArrowHead { tip, direction } = *arrow;
    let base = arrow.base();
    let side = |sign: f64| {
        Point::new(
            base.x - sign * ARROW_HALF_WIDTH * direction.y,
            base.y + sign * ARROW_HALF_WIDTH * direction.x,
        )
    };
    let (left, right) = (side(1.0), side(-1.0));
    format!("M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}Z", tip.x, tip.y, left.x, left.y, right.x, right.y)
}
