//! Points in metres (or radians), and the paths between them.

/// x, y, z in metres; the two joint angles and zero for an arm.
pub(crate) type Point = [f64; 3];

pub(crate) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn raised(point: Point, height: f64) -> Point {
    add(point, [0.0, 0.0, height])
}

/// `a` at share 0, `b` at share 1.
pub(crate) fn mix(a: Point, b: Point, share: f64) -> Point {
    let along = |axis: usize| a[axis] + (b[axis] - a[axis]) * share;
    [along(0), along(1), along(2)]
}

pub(crate) fn distance(a: Point, b: Point) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

/// Distance to the nearest of the others; infinite when there are none.
pub(crate) fn nearest(point: Point, others: impl IntoIterator<Item = Point>) -> f64 {
    let distances = others.into_iter().map(|other| distance(point, other));
    distances.fold(f64::INFINITY, f64::min)
}

/// A polyline with at least one point.
pub(crate) struct Path(Vec<Point>);

impl Path {
    pub(crate) fn through(points: &[Point]) -> Self {
        Self(points.to_vec())
    }

    /// A quadratic Bezier curve whose middle is `bulge` off the straight line.
    pub(crate) fn arc(from: Point, to: Point, bulge: Point) -> Self {
        const LEGS: usize = 24;
        let control = add(mix(from, to, 0.5), add(bulge, bulge));
        let point = |leg: usize| {
            let share = leg as f64 / LEGS as f64;
            let (first, second) = (mix(from, control, share), mix(control, to, share));
            mix(first, second, share)
        };
        Self((0..=LEGS).map(point).collect())
    }

    pub(crate) fn length(&self) -> f64 {
        self.0.windows(2).map(|leg| distance(leg[0], leg[1])).sum()
    }

    /// The first part of the path, up to this share of the length.
    pub(crate) fn until(&self, share: f64) -> Self {
        let mut points = vec![self.0[0]];
        let mut walked = 0.0;
        for leg in self.0.windows(2) {
            walked += distance(leg[0], leg[1]);
            if walked < share * self.length() {
                points.push(leg[1]);
            }
        }
        points.push(self.at(share));
        Self(points)
    }

    /// The remaining part of the path, from this share of the length.
    pub(crate) fn from(&self, share: f64) -> Self {
        let reversed = Self(self.0.iter().rev().copied().collect());
        let mut points = reversed.until(1.0 - share).0;
        points.reverse();
        Self(points)
    }

    /// The point after this share of the length.
    pub(crate) fn at(&self, share: f64) -> Point {
        let mut left = share * self.length();
        let mut end = self.0[self.0.len() - 1];
        for leg in self.0.windows(2) {
            let length = distance(leg[0], leg[1]);
            if left < length {
                end = mix(leg[0], leg[1], left / length);
                break;
            }
            left -= length;
        }
        end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_walked_by_length() {
        let path = Path::through(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 3.0, 0.0]]);
        assert!(distance(path.at(0.0), [0.0, 0.0, 0.0]) < 1e-9);
        assert!(distance(path.at(0.5), [1.0, 1.0, 0.0]) < 1e-9);
        assert!(distance(path.at(1.0), [1.0, 3.0, 0.0]) < 1e-9);
    }

    #[test]
    fn a_path_is_cut_in_two() {
        let path = Path::through(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 3.0, 0.0]]);
        let (first, second) = (path.until(0.5), path.from(0.5));
        assert_eq!(first.0, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
        assert_eq!(second.0, [[1.0, 1.0, 0.0], [1.0, 3.0, 0.0]]);
    }

    #[test]
    fn an_arc_meets_its_ends_and_its_bulge() {
        let path = Path::arc([0.0; 3], [0.4, 0.0, 0.0], [0.0, 0.0, 0.1]);
        assert!(distance(path.at(0.0), [0.0, 0.0, 0.0]) < 1e-9);
        assert!(distance(path.at(0.5), [0.2, 0.0, 0.1]) < 1e-9);
        assert!(distance(path.at(1.0), [0.4, 0.0, 0.0]) < 1e-9);
    }
}
