//! Points of up to three axes; the third is zero where a thing has two.

/// Metres or radians.
pub(super) type Point = [f64; 3];

pub(super) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn subtract(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn scale(a: Point, factor: f64) -> Point {
    a.map(|value| value * factor)
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    let [x, y, z] = subtract(a, b);
    (x * x + y * y + z * z).sqrt()
}
