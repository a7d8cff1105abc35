//! The same on recordings: those that the tests read and the samples.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import};
use goalgraph::parameters::choose_parameters;
use goalgraph::points::{Points, Track};
use goalgraph::rest::{SubsetRecording, stays};
use goalgraph::subset::propose_subsets;

use super::{ALGORITHMS, compare, said};
use crate::Options;
use crate::measure::Spread;
use crate::report::{Report, times};

/// Folders of recordings, and whether their tables name their columns.
const FOLDERS: [(&str, Header); 7] = [
    ("shared/tests/data/panda-stack-and-one", Header::Detect),
    ("shared/tests/data/lego-assembly", Header::Absent),
    ("assets/samples/tower", Header::Detect),
    ("assets/samples/two-stacks", Header::Detect),
    ("assets/samples/four-places", Header::Detect),
    ("assets/samples/drone", Header::Detect),
    ("assets/samples/arm", Header::Detect),
];

pub(super) fn run(options: &Options, report: &mut Report, python: &Path) -> Result<()> {
    let script = options.script("dbscan.py");
    for (folder, header) in FOLDERS {
        let demonstrations = read(&options.root.join(folder), header)?;
        let (mut ratios, mut points, mut clusters, mut borders) = (Vec::new(), 0, 0, 0);
        for recording in recordings(&demonstrations) {
            let dimension = recording.features.len();
            let parameters = choose_parameters(&stays(std::slice::from_ref(&recording))[0], dimension);
            let all = all_points(&recording);
            let compared = compare(python, &script, &all, parameters, ALGORITHMS[0])
                .with_context(|| format!("{folder}, {}", recording.name))?;
            ratios.push(compared.turns.ratio(0, 1).median);
            points += all.len();
            clusters += compared.clusters;
            borders += compared.borders;
        }
        let measured = format!("{}, {}", times(Spread::of(&ratios)), said(borders, clusters));
        report.row(format!("{folder}: {points} points, subsets: {}", ratios.len()), measured);
    }
    Ok(())
}

/// The demonstrations in the tables of a folder, in the order of their names.
fn read(folder: &Path, header: Header) -> Result<Vec<Demonstration>> {
    let mut paths: Vec<_> = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
    paths.retain(|path| is_recording(path));
    paths.sort();
    ensure!(!paths.is_empty(), "{} holds no recordings", folder.display());
    let mut demonstrations = Vec::new();
    for path in paths {
        let bytes = fs::read(&path)?;
        demonstrations.extend(import(&path.to_string_lossy(), &bytes, header)?);
    }
    Ok(demonstrations)
}

/// Words beside the recordings are none.
fn is_recording(path: &Path) -> bool {
    let is_table = path.extension().is_some_and(|extension| extension == "csv" || extension == "txt");
    is_table && path.file_stem().is_some_and(|stem| stem != "words")
}

/// The proposed subsets in all demonstrations.
fn recordings(demonstrations: &[Demonstration]) -> Vec<SubsetRecording> {
    let Some(first) = demonstrations.first() else { return Vec::new() };
    let subset = |features: &[String]| {
        let track = |demonstration: &Demonstration| {
            let columns: Vec<usize> =
                features.iter().filter_map(|feature| demonstration.feature_index(feature)).collect();
            Track::new(demonstration, &columns)
        };
        demonstrations.iter().map(track).collect()
    };
    propose_subsets(first.features())
        .into_iter()
        .map(|request| SubsetRecording::new(&request.name, &request.features, subset(&request.features)))
        .collect()
}

fn all_points(recording: &SubsetRecording) -> Points {
    let mut points = Points::new(recording.features.len());
    for point in recording.tracks.iter().flat_map(|track| track.points.iter()) {
        points.push(point);
    }
    points
}
