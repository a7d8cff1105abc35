//! Points, boxes and curves.

use serde::{Deserialize, Serialize};

/// A place or a direction in the drawing space.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Down.
    pub y: f64,
}

impl Point {
    /// The point at `x`, `y`.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    pub(super) fn shifted(self, by: Self) -> Self {
        Self::new(self.x + by.x, self.y + by.y)
    }

    /// The point with its axes swapped.
    pub(super) fn swapped(self) -> Self {
        Self::new(self.y, self.x)
    }

    fn mix(self, other: Self, share: f64) -> Self {
        Self::new(self.x + (other.x - self.x) * share, self.y + (other.y - self.y) * share)
    }
}

/// A cubic Bézier curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CubicBezier {
    /// Where it starts.
    pub start: Point,
    /// The control point that it leaves towards.
    pub control_1: Point,
    /// The control point that it arrives from.
    pub control_2: Point,
    /// Where it ends.
    pub end: Point,
}

impl CubicBezier {
    /// The straight line from `start` to `end`.
    pub(super) fn line(start: Point, end: Point) -> Self {
        Self { start, control_1: start.mix(end, 1.0 / 3.0), control_2: start.mix(end, 2.0 / 3.0), end }
    }

    /// The point at parameter `t` between 0 and 1, by de Casteljau's algorithm.
    pub fn at(&self, t: f64) -> Point {
        let (a, b) = (self.start.mix(self.control_1, t), self.control_1.mix(self.control_2, t));
        let c = self.control_2.mix(self.end, t);
        a.mix(b, t).mix(b.mix(c, t), t)
    }

    /// The same curve from its end to its start.
    pub(super) fn reversed(self) -> Self {
        Self { start: self.end, control_1: self.control_2, control_2: self.control_1, end: self.start }
    }

    /// The curve with every point put through `change`.
    pub(super) fn map(self, change: impl Fn(Point) -> Point) -> Self {
        Self {
            start: change(self.start),
            control_1: change(self.control_1),
            control_2: change(self.control_2),
            end: change(self.end),
        }
    }

    /// Its four points; the curve lies within their hull.
    pub(super) fn points(&self) -> [Point; 4] {
        [self.start, self.control_1, self.control_2, self.end]
    }
}

/// A box with sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rect {
    /// Left side.
    pub left: f64,
    /// Upper side.
    pub top: f64,
    /// Right side.
    pub right: f64,
    /// Lower side.
    pub bottom: f64,
}

impl Rect {
    /// The box of a size around its center.
    pub fn centered(center: Point, width: f64, height: f64) -> Self {
        let (x, y) = (width / 2.0, height / 2.0);
        Self { left: center.x - x, top: center.y - y, right: center.x + x, bottom: center.y + y }
    }

    /// Area that both boxes cover; zero when they only touch.
    pub fn overlap(&self, other: &Self) -> f64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        if width > 0.0 && height > 0.0 { width * height } else { 0.0 }
    }

    /// Whether the point is in the box, its border included.
    pub fn contains(&self, point: Point) -> bool {
        (self.left..=self.right).contains(&point.x) && (self.top..=self.bottom).contains(&point.y)
    }

    /// The smallest box that holds both.
    pub(super) fn union(&self, other: &Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// The box with `margin` more on every side.
    pub(super) fn grown(&self, margin: f64) -> Self {
        Self {
            left: self.left - margin,
            top: self.top - margin,
            right: self.right + margin,
            bottom: self.bottom + margin,
        }
    }
}
