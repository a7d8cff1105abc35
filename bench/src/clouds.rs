//! Points to cluster, with the parameters they are clustered with.

use goalgraph::dbscan::{DbscanParameters, dbscan};
use goalgraph::points::Points;
use goalgraph_tasks::{resting_points, scattered_rests, shuffled_blobs, uniform_points};

/// A kind of cloud.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cloud {
    /// Demonstrations that rest at places they share; in 3-D only.
    Resting,
    /// Demonstrations that rest where nothing rested before; in 3-D only.
    Scattered,
    /// Noise without heaps.
    Uniform,
    /// Twenty blobs in random order.
    Blobs,
}

/// Frames are clustered as the engine does with such recordings: see the test below.
const AT_REST: DbscanParameters = DbscanParameters { epsilon: 0.004, min_points: 20 };

/// About how many points the neighborhood of a point has in uniform noise, which is also its `min_points`.
const NEIGHBORS_IN_NOISE: usize = 10;

impl Cloud {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Resting, Self::Scattered, Self::Uniform, Self::Blobs];

    /// The name on the command line and in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Resting => "rests",
            Self::Scattered => "scattered-rests",
            Self::Uniform => "uniform",
            Self::Blobs => "blobs",
        }
    }

    /// The kind of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|cloud| cloud.name() == name)
    }

    /// `points` points of `dimension` coordinates (3 where things rest), the same ones every time.
    pub fn points(self, points: usize, dimension: usize) -> Points {
        let coordinates = match self {
            Self::Resting => resting_points(points, 1),
            Self::Scattered => scattered_rests(points, 1),
            Self::Uniform => uniform_points(points, dimension, 1),
            Self::Blobs => shuffled_blobs(points, dimension, 1),
        };
        Points::from_rows(dimension, coordinates)
    }

    /// What `points` points of this kind are clustered with.
    pub fn parameters(self, points: usize, dimension: usize) -> DbscanParameters {
        match self {
            Self::Resting | Self::Scattered => AT_REST,
            Self::Uniform => noise_parameters(points, dimension),
            Self::Blobs => DbscanParameters { epsilon: 0.003 * (dimension as f64).sqrt(), min_points: 10 },
        }
    }
}

/// Such that a neighborhood in the unit cube has about `min_points` points.
fn noise_parameters(points: usize, dimension: usize) -> DbscanParameters {
    let volume = NEIGHBORS_IN_NOISE as f64 / points.max(1) as f64;
    let epsilon = (volume / unit_ball(dimension)).powf(1.0 / dimension.max(1) as f64);
    DbscanParameters { epsilon, min_points: NEIGHBORS_IN_NOISE }
}

/// Volume of the ball of radius one.
fn unit_ball(dimension: usize) -> f64 {
    match dimension {
        0 => 1.0,
        1 => 2.0,
        _ => std::f64::consts::TAU / dimension as f64 * unit_ball(dimension - 2),
    }
}

/// The cluster of each point, `None` for noise.
pub fn labels(points: &Points, parameters: DbscanParameters) -> Vec<Option<usize>> {
    dbscan(points, parameters).iter().collect()
}

#[cfg(test)]
mod tests {
    use goalgraph::parameters::choose_parameters;
    use goalgraph::points::Track;
    use goalgraph::rest::{SubsetRecording, stays};
    use goalgraph_tasks::FRAMES_OF_A_DEMONSTRATION;

    use super::*;

    #[test]
    fn things_at_rest_are_clustered_with_parameters_like_those_the_engine_chooses() {
        let points = Cloud::Resting.points(30 * FRAMES_OF_A_DEMONSTRATION, 3);
        let rows: Vec<&[f64]> = points.iter().collect();
        let track = |rows: &[&[f64]]| Track::observed_throughout(Points::from_rows(3, rows.concat()));
        let tracks = rows.chunks(FRAMES_OF_A_DEMONSTRATION).map(track).collect();
        let features = ["x", "y", "z"].map(str::to_owned);
        let recording = SubsetRecording::new("thing", &features, tracks);
        let chosen = choose_parameters(&stays(&[recording])[0], 3);
        assert_eq!(chosen.min_points, AT_REST.min_points, "{chosen:?}");
        assert!((0.5..2.0).contains(&(chosen.epsilon / AT_REST.epsilon)), "{chosen:?}");
    }

    #[test]
    fn neighborhoods_in_noise_have_about_as_many_points_as_a_core_point_needs() {
        // At three times the radius, where there are enough of them to count.
        for (dimension, expected) in [(2, 90.0), (3, 270.0)] {
            let points = Cloud::Uniform.points(20_000, dimension);
            let parameters = Cloud::Uniform.parameters(20_000, dimension);
            let middle = vec![0.5; dimension];
            let distance = |point: &[f64]| goalgraph::points::distance(point, &middle);
            let near = points.iter().filter(|point| distance(point) <= 3.0 * parameters.epsilon).count();
            assert!((0.7..1.4).contains(&(near as f64 / expected)), "{near} in {dimension}-D");
        }
        assert!((unit_ball(3) - 4.0 / 3.0 * std::f64::consts::PI).abs() < 1e-12);
        assert!((unit_ball(6) - std::f64::consts::PI.powi(3) / 6.0).abs() < 1e-12);
    }

    #[test]
    fn the_four_heaps_and_the_loose_start_are_found() {
        let points = Cloud::Resting.points(9000, 3);
        let labels = labels(&points, Cloud::Resting.parameters(9000, 3));
        let clusters = labels.iter().flatten().max().map_or(0, |last| last + 1);
        assert!(clusters >= 4, "{clusters}");
    }
}
