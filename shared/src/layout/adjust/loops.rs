//! Self-loops that are drawn anew: above their box beyond those that stay, or below it where there is more room.

use super::canvas::{Canvas, NOBODY};
use super::spots::Spot;
use crate::layout::extents::{LOOP_LABEL_GAP, LOOP_RISE};
use crate::layout::graph::Size;
use crate::layout::route::CORNER;
use crate::layout::self_loops::{LARGEST_HALF, Loop, loop_around};
use crate::layout::{ArrowHead, CubicBezier, EdgePath, Point};

/// How much wider a loop is than what it runs around, to each side.
const ROOM: f64 = 8.0;

/// The loops on one side of a node that are drawn already: how far they reach from the border, labels included, and half
/// their width.
#[derive(Clone, Copy, Debug, Default)]
struct Stack {
    count: usize,
    top: f64,
    half: f64,
}

impl Stack {
    /// How far the top of one more loop is from the border.
    fn rise(&self) -> f64 {
        self.top + LOOP_RISE + if self.count == 0 { 0.0 } else { LOOP_LABEL_GAP }
    }
}

/// The loops of a node.
#[derive(Clone, Debug)]
pub(super) struct Loops {
    spot: Spot,
    /// How many there will be.
    total: usize,
    /// Above and below.
    stacks: [Stack; 2],
}

impl Loops {
    pub(super) fn new(spot: Spot) -> Self {
        Self { spot, total: 0, stacks: [Stack::default(); 2] }
    }

    /// Notes that there is one more loop, to be kept or added.
    pub(super) fn expect(&mut self) {
        self.total += 1;
    }

    /// Notes a loop that stays; `label` is the size of its label.
    pub(super) fn keep(&mut self, edge: &EdgePath, label: Size) {
        let rect = self.spot.rect();
        let points: Vec<Point> = edge.path.iter().flat_map(CubicBezier::points).collect();
        let is_below = points.iter().any(|point| point.y > rect.bottom + 1.0);
        let beyond = if is_below { edge.label.y - rect.bottom } else { rect.top - edge.label.y };
        let aside = points.iter().map(|point| (point.x - self.spot.center.x).abs());
        let stack = &mut self.stacks[usize::from(is_below)];
        stack.count += 1;
        stack.half = aside.fold(stack.half.max(label.width / 2.0), f64::max) + ROOM;
        stack.top = stack.top.max(beyond.max(0.0) + label.height / 2.0);
    }

    /// Path, head and label of one more loop.
    pub(super) fn add(&mut self, canvas: &Canvas, label: Size) -> (Vec<CubicBezier>, ArrowHead, Point) {
        let is_below = !self.is_free(canvas, label, false) && self.is_free(canvas, label, true);
        let (center, size) = (self.spot.center, self.spot.size);
        let stack = &mut self.stacks[usize::from(is_below)];
        let foot = foot(size, stack.count, self.total);
        let (half_width, rise) = (stack.half.max(foot), stack.rise());
        let (path, arrow) = loop_around(&Loop { center, size, foot, half_width, rise });
        stack.count += 1;
        stack.half = half_width.max(label.width / 2.0) + ROOM;
        stack.top = rise + LOOP_LABEL_GAP + label.height;
        let place = Point::new(center.x, center.y - size.height / 2.0 - stack.top + label.height / 2.0);
        if !is_below {
            return (path, arrow, place);
        }
        let mirrored = |point: Point| Point::new(point.x, 2.0 * center.y - point.y);
        let path = path.into_iter().map(|curve| curve.map(mirrored)).collect();
        let direction = Point::new(arrow.direction.x, -arrow.direction.y);
        (path, ArrowHead { tip: mirrored(arrow.tip), direction }, mirrored(place))
    }

    /// Whether one more loop and its label cover nothing there.
    fn is_free(&self, canvas: &Canvas, label: Size, is_below: bool) -> bool {
        let (rect, center) = (self.spot.rect(), self.spot.center);
        let stack = &self.stacks[usize::from(is_below)];
        // What is measured has a margin, which must not touch the box.
        let (near, far) = (stack.top + 3.0, stack.rise() + LOOP_LABEL_GAP + label.height);
        let size = Size { width: 2.0 * stack.half.max(label.width / 2.0), height: far - near };
        let middle = f64::midpoint(near, far);
        let y = if is_below { rect.bottom + middle } else { rect.top - middle };
        canvas.label_cost(NOBODY, Point::new(center.x, y), size) < 1.0
    }
}

/// Half the distance of the ends of the loop `at` of `total`, counted from the box.
fn foot(size: Size, at: usize, total: usize) -> f64 {
    let reach = (size.width / 2.0 - CORNER).max(size.width / 4.0).min(LARGEST_HALF);
    reach * (at + 1) as f64 / (total.max(at + 1) + 1) as f64
}
