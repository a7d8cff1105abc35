//! Sides of boxes, and which of them an edge joins.

use crate::layout::graph::Size;
use crate::layout::route::CORNER;
use crate::layout::{Point, Rect};

/// Room between two boxes from which an edge runs between the sides that face each other, and the least that it can do with.
const ROOM: f64 = 26.0;
const LEAST_ROOM: f64 = 14.0;

/// Edges run along the flow unless the boxes are this much farther apart across it.
const STEEPEST: f64 = 4.0;

/// A side of a box in flow space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Side {
    Right,
    Left,
    Down,
    Up,
}

impl Side {
    /// The unit vector out of the box.
    pub(super) fn outward(self) -> Point {
        match self {
            Self::Right => Point::new(1.0, 0.0),
            Self::Left => Point::new(-1.0, 0.0),
            Self::Down => Point::new(0.0, 1.0),
            Self::Up => Point::new(0.0, -1.0),
        }
    }

    /// Whether edges leave it along the flow.
    pub(super) fn is_along(self) -> bool {
        matches!(self, Self::Right | Self::Left)
    }

    /// The point of the side that is `offset` from its middle.
    pub(super) fn point(self, rect: &Rect, offset: f64) -> Point {
        let middle = Point::new(f64::midpoint(rect.left, rect.right), f64::midpoint(rect.top, rect.bottom));
        match self {
            Self::Right => Point::new(rect.right, middle.y + offset),
            Self::Left => Point::new(rect.left, middle.y + offset),
            Self::Down => Point::new(middle.x + offset, rect.bottom),
            Self::Up => Point::new(middle.x + offset, rect.top),
        }
    }

    /// How far from the middle of a side edges may meet it.
    pub(super) fn reach(self, size: Size) -> f64 {
        let length = if self.is_along() { size.height } else { size.width };
        (length / 2.0 - CORNER).max(length / 4.0)
    }

    /// The side of `rect` that `point` is nearest to, and how far from its middle.
    pub(super) fn of(rect: &Rect, point: Point) -> (Self, f64) {
        let sides = [
            (Self::Right, (rect.right - point.x).abs()),
            (Self::Left, (rect.left - point.x).abs()),
            (Self::Down, (rect.bottom - point.y).abs()),
            (Self::Up, (rect.top - point.y).abs()),
        ];
        let nearest = sides.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
        let side = nearest.map_or(Self::Right, |(side, _)| side);
        let offset = match side {
            Self::Right | Self::Left => point.y - f64::midpoint(rect.top, rect.bottom),
            Self::Down | Self::Up => point.x - f64::midpoint(rect.left, rect.right),
        };
        (side, offset)
    }
}

/// The sides at which an edge leaves the box `from` and enters the box `to`: those that face each other; where the boxes are
/// too close for that, their upper ones.
pub(super) fn sides(from: &Rect, to: &Rect) -> [Side; 2] {
    let (right, left) = (to.left - from.right, from.left - to.right);
    let (down, up) = (to.top - from.bottom, from.top - to.bottom);
    let (along, across) = (right.max(left), down.max(up));
    let along_sides = if right >= left { [Side::Right, Side::Left] } else { [Side::Left, Side::Right] };
    let across_sides = if down >= up { [Side::Down, Side::Up] } else { [Side::Up, Side::Down] };
    match () {
        () if along >= ROOM && along * STEEPEST >= across => along_sides,
        () if across >= ROOM => across_sides,
        () if along >= LEAST_ROOM => along_sides,
        () if across >= LEAST_ROOM => across_sides,
        () => [Side::Up, Side::Up],
    }
}
