//! Curves between two ports, and what can be told about curves.

use super::sides::Side;
use crate::layout::route::level_ended;
use crate::layout::{ARROW_LENGTH, ArrowHead, CubicBezier, Point, Rect};

/// An edge's two ends on the borders of its boxes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ends {
    pub(super) start: Point,
    pub(super) start_side: Side,
    pub(super) tip: Point,
    pub(super) tip_side: Side,
}

impl Ends {
    pub(super) fn arrow(&self) -> ArrowHead {
        let out = self.tip_side.outward();
        ArrowHead { tip: self.tip, direction: Point::new(-out.x, -out.y) }
    }
}

/// The curve from border to head that leaves and enters its boxes upright to their sides, and bows out by `lane` in
/// between: across the flow, or along it when the sides do not look along.
pub(super) fn direct(ends: &Ends, lane: f64) -> Vec<CubicBezier> {
    let (start, end) = (ends.start, ends.arrow().base());
    if ends.start_side == ends.tip_side {
        return vec![over(ends, lane)];
    }
    let swap = |point: Point| if ends.start_side.is_along() { point } else { point.swapped() };
    let (start, end) = (swap(start), swap(end));
    if lane.abs() < f64::EPSILON {
        return vec![level_ended(start, end).map(swap)];
    }
    let middle = Point::new(f64::midpoint(start.x, end.x), f64::midpoint(start.y, end.y) + lane);
    [level_ended(start, middle), level_ended(middle, end)].map(|curve| curve.map(swap)).into()
}

/// The arc between two points on upper sides, higher with the lane.
fn over(ends: &Ends, lane: f64) -> CubicBezier {
    const RISE: f64 = 46.0;
    let (start, end) = (ends.start, ends.arrow().base());
    let top = start.y.min(end.y) - RISE - lane.abs();
    CubicBezier { start, control_1: Point::new(start.x, top), control_2: Point::new(end.x, top), end }
}

/// The smallest box with sides along the axes that holds the hulls of the curves.
pub(super) fn hull(path: &[CubicBezier]) -> Option<Rect> {
    let points = path.iter().flat_map(CubicBezier::points);
    points.map(|point| Rect::centered(point, 0.0, 0.0)).reduce(|all, point| all.union(&point))
}

/// Points along a curve, about `step` apart, its ends left out.
pub(super) fn samples(curve: &CubicBezier, step: f64) -> impl Iterator<Item = Point> + use<> {
    const MAX_SAMPLES: f64 = 240.0;
    let count = (length(curve) / step).clamp(3.0, MAX_SAMPLES) as usize;
    let curve = *curve;
    (0..count).map(move |at| curve.at((at as f64 + 0.5) / count as f64))
}

/// Lines that follow a curve closely.
pub(super) fn chords(curve: &CubicBezier) -> impl Iterator<Item = [Point; 2]> + use<> {
    const LENGTH: f64 = 24.0;
    const MAX_CHORDS: f64 = 48.0;
    let count = (length(curve) / LENGTH).clamp(4.0, MAX_CHORDS) as usize;
    let curve = *curve;
    let at = move |step: usize| curve.at(step as f64 / count as f64);
    (0..count).map(move |step| [at(step), at(step + 1)])
}

/// How far apart small boxes stand for a curve, and their sides.
pub(super) const INK_STEP: f64 = 11.0;
pub(super) const INK_SIDE: f64 = 8.0;

/// Small boxes along a curve.
pub(super) fn strips(curve: &CubicBezier) -> impl Iterator<Item = Rect> + use<> {
    samples(curve, INK_STEP).map(|point| Rect::centered(point, INK_SIDE, INK_SIDE))
}

/// The length of the curve's control polygon, which is a little more than its own.
pub(super) fn length(curve: &CubicBezier) -> f64 {
    let points = curve.points();
    let long = |pair: &[Point]| {
        let (x, y) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
        (x * x + y * y).sqrt()
    };
    points.windows(2).map(long).sum()
}

/// The point at `share` of the length of curves that follow each other.
pub(super) fn point_along(path: &[CubicBezier], share: f64) -> Point {
    let lengths: Vec<f64> = path.iter().map(length).collect();
    let mut left = share * lengths.iter().sum::<f64>();
    for (curve, length) in path.iter().zip(&lengths) {
        if left <= *length {
            return curve.at(if *length > 0.0 { left / length } else { 0.5 });
        }
        left -= length;
    }
    path.last().map_or_else(Point::default, |curve| curve.end)
}

/// Room at the end of a path that belongs to the arrow head.
pub(super) const HEAD_ROOM: f64 = 2.0 * ARROW_LENGTH;
