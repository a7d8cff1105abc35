//! Whether two clusterings are one by the definition: the same noise, the same clusters of core points up to their
//! numbers, and border points in a cluster of which a core point is near.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use goalgraph::dbscan::DbscanParameters;
use goalgraph::points::{Points, squared_distance};

/// What scikit-learn found.
pub(super) struct Theirs {
    labels: Vec<Option<usize>>,
    is_core: Vec<bool>,
}

impl Theirs {
    /// From the file that `bench/peers/dbscan.py` writes.
    pub(super) fn read(file: &Path, points: usize) -> Result<Self> {
        let bytes = std::fs::read(file).with_context(|| format!("cannot read {}", file.display()))?;
        let number = |bytes: &[u8]| bytes.try_into().map(i64::from_le_bytes);
        let numbers: Vec<i64> = bytes.chunks_exact(8).map(number).collect::<Result<_, _>>()?;
        ensure!(numbers.len() == 2 * points, "{} labels for {points} points", numbers.len() / 2);
        let (labels, core) = numbers.split_at(points);
        Ok(Self {
            labels: labels.iter().map(|&label| usize::try_from(label).ok()).collect(),
            is_core: core.iter().map(|&core| core == 1).collect(),
        })
    }

    /// How many clusters there are.
    pub(super) fn clusters(&self) -> usize {
        self.labels.iter().flatten().max().map_or(0, |last| last + 1)
    }
}

/// How many border points are in another cluster with us, each of which is allowed by the definition.
///
/// # Errors
///
/// When the clusterings differ in anything else.
pub(super) fn differing_borders(
    points: &Points,
    parameters: DbscanParameters,
    ours: &[Option<usize>],
    theirs: &Theirs,
) -> Result<usize> {
    let (mut their_name, mut our_name) = (BTreeMap::new(), BTreeMap::new());
    for (index, (our, their)) in ours.iter().zip(&theirs.labels).enumerate() {
        match (our, their) {
            (Some(our), Some(their)) if theirs.is_core[index] => {
                let is_one = *their_name.entry(our).or_insert(their) == their
                    && *our_name.entry(their).or_insert(our) == our;
                ensure!(is_one, "core point {index}: our cluster {our} is not their cluster {their}");
            }
            (None, None) | (Some(_), Some(_)) => {}
            _ => bail!("point {index} is noise for one of us: ours {our:?}, theirs {their:?}"),
        }
    }
    let mut differing = 0;
    for (index, (our, their)) in ours.iter().zip(&theirs.labels).enumerate() {
        let (Some(our), Some(their)) = (our, their) else { continue };
        if our_name.get(their) == Some(&our) {
            continue;
        }
        let reaches = |other: usize| {
            theirs.is_core[other]
                && ours[other] == Some(*our)
                && squared_distance(points.point(index), points.point(other))
                    <= parameters.epsilon * parameters.epsilon
        };
        let is_allowed = (0..points.len()).any(reaches);
        ensure!(is_allowed, "border point {index} is in our cluster {our}, which has no core point near");
        differing += 1;
    }
    Ok(differing)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a line with epsilon 1: two clusters with core points at 0 and 2, and a border point at 1 between them.
    fn check(ours: [Option<usize>; 4], expected: Result<usize, &str>) {
        let points = Points::from_rows(1, vec![0.0, 1.0, 2.0, 9.0]);
        let theirs =
            Theirs { labels: vec![Some(0), Some(0), Some(1), None], is_core: vec![true, false, true, false] };
        let parameters = DbscanParameters { epsilon: 1.0, min_points: 2 };
        let found = differing_borders(&points, parameters, &ours, &theirs).map_err(|error| error.to_string());
        assert_eq!(found, expected.map_err(str::to_owned));
    }

    #[test]
    fn numbers_of_clusters_say_nothing() {
        check([Some(1), Some(1), Some(0), None], Ok(0));
    }

    #[test]
    fn a_border_point_may_go_to_either_neighbor() {
        check([Some(0), Some(1), Some(1), None], Ok(1));
    }

    #[test]
    fn core_points_and_noise_must_be_equal() {
        check([Some(0), Some(0), Some(0), None], Err("core point 2: our cluster 0 is not their cluster 1"));
        check(
            [Some(0), None, Some(1), None],
            Err("point 1 is noise for one of us: ours None, theirs Some(0)"),
        );
        check(
            [Some(0), Some(2), Some(1), None],
            Err("border point 1 is in our cluster 2, which has no core point near"),
        );
    }
}
