//! Points arranged for asking which are in a ball, without looking at all of them for every ball.

use crate::kd_tree::KdTree;
use crate::specification::Ball;

/// Points by where they are; they are known by their positions.
pub(super) struct Arranged(KdTree);

impl Arranged {
    /// `points` of `dimension` coordinates each.
    ///
    /// # Complexity
    ///
    /// O(n log n x features).
    pub(super) fn new<'a>(dimension: usize, points: impl Iterator<Item = &'a [f64]>) -> Self {
        Self(KdTree::new(dimension, &points.collect::<Vec<_>>()))
    }

    /// The positions of the points that `ball` [contains](Ball::contains), ascending.
    ///
    /// # Complexity
    ///
    /// O(log n) for n points and O(m log m) for the m in the ball, in few dimensions; O(n) at worst.
    pub(super) fn inside(&self, ball: &Ball) -> Vec<usize> {
        let within = square_beyond(ball.radius);
        let mut inside = Vec::new();
        self.0.search(
            &ball.center,
            within,
            |_| false,
            |slot, _| {
                if ball.contains(self.0.point(slot)) {
                    inside.push(self.0.position(slot));
                }
                within
            },
        );
        inside.sort_unstable();
        inside
    }

    /// The position of a point that is next to the one at `position`, which is `point`; none when it is the only one.
    ///
    /// # Complexity
    ///
    /// O(log n) for n points in few dimensions; O(n) at worst.
    pub(super) fn nearest_other(&self, position: usize, point: &[f64]) -> Option<usize> {
        let (mut nearest, mut within) = (None, f64::INFINITY);
        self.0.search(
            point,
            within,
            |_| false,
            |slot, squared| {
                if self.0.position(slot) != position {
                    (nearest, within) = (Some(self.0.position(slot)), squared);
                }
                within
            },
        );
        nearest
    }
}

/// A little more than the square of `radius`: a squared distance above it has a root above `radius`, however both are
/// rounded.
fn square_beyond(radius: f64) -> f64 {
    radius * radius * (1.0 + 8.0 * f64::EPSILON) + f64::MIN_POSITIVE
}

#[cfg(test)]
pub(super) mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::distance;

    /// Points of one to four coordinates, of which many are alike.
    pub(in crate::sub_goal) fn points() -> impl Strategy<Value = Vec<Vec<f64>>> {
        let coordinate = prop_oneof![
            3 => -1.0..1.0,
            3 => (0..4_i32).prop_map(|x| 0.25 * f64::from(x)),
            1 => prop_oneof![Just(1e100), Just(-1e100), Just(1e-170), Just(f64::MIN_POSITIVE), Just(-0.0)],
        ];
        (1..5_usize).prop_flat_map(move |dimension| {
            prop::collection::vec(prop::collection::vec(coordinate.clone(), dimension), 0..60)
        })
    }

    /// Balls around points, of which many have another point just on their surface.
    pub(in crate::sub_goal) fn balls(points: &[Vec<f64>], radii: &[f64]) -> Vec<Ball> {
        let radius = |center: &Vec<f64>, number: usize| match number % 3 {
            0 => radii[number % radii.len()],
            _ => distance(center, &points[(7 * number) % points.len()]),
        };
        let ball = |(number, center): (usize, &Vec<f64>)| Ball {
            subset: String::new(),
            features: Vec::new(),
            center: center.clone(),
            radius: radius(center, number),
        };
        points.iter().enumerate().map(ball).collect()
    }

    fn arranged(points: &[Vec<f64>]) -> Arranged {
        Arranged::new(points.first().map_or(1, Vec::len), points.iter().map(Vec::as_slice))
    }

    proptest! {
        #[test]
        fn those_in_a_ball_are_those_that_it_contains(
            points in points(), radii in prop::collection::vec(prop_oneof![0.0..1.5, Just(0.25), Just(0.0)], 5),
        ) {
            let arranged = arranged(&points);
            for ball in balls(&points, &radii) {
                let all = 0..points.len();
                let expected: Vec<usize> = all.filter(|&position| ball.contains(&points[position])).collect();
                prop_assert_eq!(arranged.inside(&ball), expected);
            }
        }

        #[test]
        fn no_other_point_is_nearer_than_the_nearest(points in points()) {
            let arranged = arranged(&points);
            for (position, point) in points.iter().enumerate() {
                let to = |other: usize| distance(point, &points[other]);
                let others = (0..points.len()).filter(|&other| other != position);
                let least = others.map(to).min_by(f64::total_cmp);
                let nearest = arranged.nearest_other(position, point);
                prop_assert!(nearest != Some(position));
                prop_assert_eq!(nearest.map(to), least);
            }
        }
    }
}
