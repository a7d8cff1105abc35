//! A k-d tree for the distance of the k-th neighbor, and nothing else.
//!
//! At rest a coordinate repeats thousands of times over. Where points are halved by their number and not by a value, as
//! here, that makes no difference; kiddo's trees refuse it.

use crate::points::{Points, squared_distance};

/// So many points are looked through rather than halved again.
const LEAF: usize = 16;

/// Points halved over and over, across the widest extent of each half (Bentley 1975).
pub(super) struct Tree {
    /// The points, those of each half together.
    points: Points,
    /// Where they are halved: the whole at 1, the halves of what is halved at `i` at `2 i` and `2 i + 1`.
    cuts: Vec<Cut>,
}

/// No point of the first half is beyond `value` along `axis`, no point of the second before it.
#[derive(Clone, Copy, Default)]
struct Cut {
    axis: usize,
    value: f64,
}

/// Some of the points: what is halved at `cut`, from one position to another.
#[derive(Clone, Copy)]
struct Part {
    cut: usize,
    from: usize,
    to: usize,
}

impl Part {
    fn is_leaf(self) -> bool {
        self.to - self.from <= LEAF
    }

    fn halves(self) -> (Self, Self) {
        let Self { cut, from, to } = self;
        let middle = usize::midpoint(from, to);
        (Self { cut: 2 * cut, from, to: middle }, Self { cut: 2 * cut + 1, from: middle, to })
    }
}

impl Tree {
    /// The tree of `points`.
    ///
    /// # Complexity
    ///
    /// O(n log n) for n points.
    pub(super) fn new(points: &Points) -> Self {
        let mut order: Vec<usize> = (0..points.len()).collect();
        // Halves of one generation differ by one point at most, so that the cuts fill their places nearly without gaps.
        let mut cuts = vec![Cut::default(); 2 * points.len() / LEAF + 2];
        halve(points, &mut order, Part { cut: 1, from: 0, to: points.len() }, &mut cuts);
        let mut sorted = Points::new(points.dimension());
        for point in order {
            sorted.push(points.point(point));
        }
        Self { points: sorted, cuts }
    }

    /// Square of the distance from `query` to the `k`-th nearest point; infinite where there are fewer.
    pub(super) fn squared_distance(&self, query: &[f64], k: usize) -> f64 {
        let mut nearest = Nearest { squares: Vec::with_capacity(k + 1), k };
        self.search(query, Part { cut: 1, from: 0, to: self.points.len() }, &mut nearest);
        nearest.bound()
    }

    fn search(&self, query: &[f64], part: Part, nearest: &mut Nearest) {
        if part.is_leaf() {
            for index in part.from..part.to {
                nearest.add(squared_distance(query, self.points.point(index)));
            }
            return;
        }
        let Cut { axis, value } = self.cuts[part.cut];
        let beyond = query[axis] - value;
        let (first, second) = part.halves();
        let (near, far) = if beyond < 0.0 { (first, second) } else { (second, first) };
        self.search(query, near, nearest);
        if beyond * beyond < nearest.bound() {
            self.search(query, far, nearest);
        }
    }
}

/// Puts the points of `part` into the order of the tree.
fn halve(points: &Points, order: &mut [usize], part: Part, cuts: &mut [Cut]) {
    if part.is_leaf() {
        return;
    }
    let (first, second) = part.halves();
    let axis = widest(points, &order[part.from..part.to]);
    let x = |point: usize| points.point(point)[axis];
    let middle = second.from - part.from;
    order[part.from..part.to].select_nth_unstable_by(middle, |&a, &b| x(a).total_cmp(&x(b)));
    cuts[part.cut] = Cut { axis, value: x(order[second.from]) };
    halve(points, order, first, cuts);
    halve(points, order, second, cuts);
}

/// The axis along which the points reach furthest.
fn widest(points: &Points, order: &[usize]) -> usize {
    let extent = |axis: usize| {
        let (low, high) = order.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &point| {
            let x = points.point(point)[axis];
            (low.min(x), high.max(x))
        });
        high - low
    };
    (0..points.dimension()).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0)
}

/// The `k` smallest squares so far, ascending.
struct Nearest {
    squares: Vec<f64>,
    k: usize,
}

impl Nearest {
    /// What a square has to be below to count.
    fn bound(&self) -> f64 {
        self.squares.get(self.k - 1).copied().unwrap_or(f64::INFINITY)
    }

    fn add(&mut self, square: f64) {
        if square < self.bound() {
            let at = self.squares.partition_point(|&known| known <= square);
            self.squares.insert(at, square);
            self.squares.truncate(self.k);
        }
    }
}
