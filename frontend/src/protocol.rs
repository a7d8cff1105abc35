//! What the page and its worker say to each other: one type on both ends.
//!
//! A message is `MessagePack`, with the names of fields: a float is five or nine bytes and need not be parsed, and NaN is
//! a number. Files to read travel beside it as the browser's handles, so their bytes are never copied through the page.

use goalgraph::demonstration::Feature;
use goalgraph::infer::{InferRequest, Progress};
use goalgraph::layout::{Layout, LayoutRequest};
use goalgraph::pdfa::Word;
use goalgraph::subset::SubsetRequest;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The bytes of a message.
pub(crate) fn encode(message: &impl Serialize) -> Vec<u8> {
    // Everything that is said can be written to memory.
    rmp_serde::to_vec_named(message).unwrap_or_default()
}

/// The message in `bytes`.
pub(crate) fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, String> {
    rmp_serde::from_slice(bytes).map_err(|error| error.to_string())
}

/// Identity of a file in the page, never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct FileId(pub u32);

/// One demonstration: a file and the position in it, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DemonstrationId {
    /// The file that holds it.
    pub file: FileId,
    /// Its position in the file.
    pub index: usize,
}

/// What the page asks for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ToWorker {
    /// Read the files that travel beside this message, in the same order, and keep their demonstrations.
    Read(Vec<FileToRead>),
    /// Forget the demonstrations of a file.
    Forget {
        /// The file.
        file: FileId,
    },
    /// Infer a specification.
    Infer {
        /// The files, in the order of their demonstrations.
        files: Vec<FileId>,
        /// What to infer and how.
        request: InferRequest,
    },
    /// Give the distances of the clustered points of a subset to their neighbors, thinned for drawing.
    KDistances {
        /// Whose points.
        of: SubsetOf,
        /// To which neighbor, the point itself counted.
        neighbor: usize,
        /// Which request this is; the answer has the same number.
        number: u32,
    },
    /// Search one subset with the parameters that it has here, and nothing else.
    Preview {
        /// The subset.
        of: SubsetOf,
        /// Which request this is; the answer has the same number.
        number: u32,
    },
    /// Give the values of one demonstration, thinned for drawing.
    Track {
        /// Which one.
        demonstration: DemonstrationId,
    },
    /// Place the states and transitions of a specification.
    LayOut {
        /// Its text.
        specification: String,
        /// Which request this is; the answer has the same number.
        number: u32,
    },
    /// Place boxes and arrows that are not those of the work.
    Place {
        /// The boxes and arrows.
        request: LayoutRequest,
        /// Which request this is; the answer has the same number.
        number: u32,
    },
    /// Draw a specification as an SVG file.
    DrawSvg {
        /// Its text.
        specification: String,
    },
}

/// One subset of an inference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SubsetOf {
    /// The files of the inference, in the order of their demonstrations.
    pub files: Vec<FileId>,
    /// What is inferred from them and how, without parameters.
    pub request: InferRequest,
    /// The subset, one of the request but for its parameters.
    pub subset: SubsetRequest,
}

/// A file beside a message.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileToRead {
    /// The identity under which its demonstrations are kept.
    pub file: FileId,
    /// What it is called.
    pub name: String,
}

/// What the worker answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FromWorker {
    /// It listens now; what was posted before is lost.
    Ready,
    /// What it says between a drop of two files and a drawn automaton, for practice.
    Rehearsal(Vec<FromWorker>),
    /// Files were read.
    Read(Vec<ReadFile>),
    /// How far the inference is.
    Progress(Progress),
    /// The inference is done.
    Inferred {
        /// What came out, or why nothing did.
        result: Result<Box<Outcome>, String>,
        /// Where everything is, in each direction of drawing, so that nobody has to ask; empty when nothing came out.
        layouts: Vec<Layout>,
    },
    /// How far the clustered points of a subset are from their neighbors.
    KDistances {
        /// The number of the request.
        number: u32,
        /// The distances, or why there are none.
        result: Result<KDistanceCurve, String>,
    },
    /// What was found in one subset.
    Previewed {
        /// The number of the request.
        number: u32,
        /// The clusters, or why there are none.
        result: Result<Clusters, String>,
    },
    /// The values of one demonstration.
    Track {
        /// Which one.
        demonstration: DemonstrationId,
        /// Its values.
        track: Track,
    },
    /// The file holds no recording but a specification.
    Opened {
        /// The file.
        file: FileId,
        /// The specification's text as Goalgraph writes it, or why it cannot be opened.
        result: Result<String, String>,
    },
    /// Where everything is, in each direction of drawing.
    LaidOut {
        /// The number of the request.
        number: u32,
        /// The layouts, or why there are none.
        result: Result<Vec<Layout>, String>,
    },
    /// Where boxes and arrows are.
    Placed {
        /// The number of the request.
        number: u32,
        /// The layout; none when they cannot be placed.
        layout: Option<Layout>,
    },
    /// The SVG file.
    Svg(Result<String, String>),
}

/// A file that was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReadFile {
    /// The file.
    pub file: FileId,
    /// What is in it, or why nothing is.
    pub result: Result<FileContent, String>,
}

/// What a file holds: at least one demonstration, all with the same features.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileContent {
    /// SHA-256 of the file, hexadecimal.
    pub sha256: String,
    /// The features.
    pub features: Vec<Feature>,
    /// The demonstrations, in the order of the file.
    pub demonstrations: Vec<DemonstrationEntry>,
}

/// A demonstration in a list.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DemonstrationEntry {
    /// Its name.
    pub name: String,
    /// How many frames it has.
    pub frames: usize,
    /// How many of its values are undefined.
    pub undefined: usize,
}

/// The result of an inference.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The specification's text, byte for byte what the command line writes.
    pub specification: String,
    /// For each demonstration its word and the frames in which its symbols were completed.
    pub completed: Vec<Completed>,
    /// Clusters that are no sub-goals.
    pub eliminated: Vec<EliminatedCluster>,
    /// Sentences for the expert.
    pub notes: Vec<String>,
    /// Observed partial states per subset, thinned for drawing.
    pub clouds: Vec<Cloud>,
}

/// When a demonstration completed its sub-goals.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Completed {
    /// Its word, as it was read.
    pub word: Word,
    /// The frames, one per symbol.
    pub frames: Vec<usize>,
}

/// A cluster that is no sub-goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EliminatedCluster {
    /// The subset it was found in.
    pub subset: String,
    /// Center, one coordinate per feature of the subset.
    pub center: Vec<f64>,
    /// Radius, in the unit of the features.
    pub radius: f64,
    /// How many frames were clustered into it.
    pub frames: usize,
    /// How many demonstrations have frames in it.
    pub demonstrations: usize,
    /// Why it is no sub-goal.
    pub reason: String,
}

/// A cluster that would be a sub-goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundCluster {
    /// Center, one coordinate per feature of the subset.
    pub center: Vec<f64>,
    /// Radius, in the unit of the features.
    pub radius: f64,
    /// How many frames were clustered into it.
    pub frames: usize,
    /// How many demonstrations have frames in it.
    pub demonstrations: usize,
}

/// The clusters of one subset; of very many those with the most frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clusters {
    /// Those that would be sub-goals.
    pub found: Vec<FoundCluster>,
    /// How many there are of them in all.
    pub found_in_all: usize,
    /// Those that would be none.
    pub eliminated: Vec<EliminatedCluster>,
    /// How many there are of them in all.
    pub eliminated_in_all: usize,
}

/// How far points are from their k-th nearest neighbor, as [`goalgraph::k_distance`] measures it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KDistanceCurve {
    /// Evenly spaced ones of the sorted distances, the first and the last included.
    pub distances: Vec<f64>,
    /// How many points are clustered.
    pub points: usize,
    /// No two points are further apart: the diagonal of the box around them.
    pub extent: f64,
}

/// Observed partial states of one subset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cloud {
    /// The subset.
    pub subset: String,
    /// How many coordinates a point has.
    pub dimensions: usize,
    /// The coordinates, point by point.
    pub coordinates: Vec<f32>,
}

/// The values of one demonstration, every `stride`-th frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Track {
    /// How many frames the demonstration has.
    pub frames: usize,
    /// The distance of two frames of the track.
    pub stride: usize,
    /// How many features a frame has.
    pub features: usize,
    /// The values frame by frame; none where undefined.
    pub values: Vec<Option<f32>>,
}

impl Track {
    /// The values of one feature over the track's frames.
    pub fn column(&self, feature: usize) -> impl Iterator<Item = Option<f32>> + '_ {
        self.values.iter().copied().skip(feature).step_by(self.features.max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_survives_the_way_through_its_bytes() {
        let track = Track { frames: 2, stride: 1, features: 1, values: vec![Some(0.5), None] };
        let demonstration = DemonstrationId { file: FileId(3), index: 1 };
        let message = FromWorker::Track { demonstration, track };
        assert_eq!(decode::<FromWorker>(&encode(&message)), Ok(message));
    }

    #[test]
    fn what_is_left_out_when_it_is_empty_comes_back() {
        // Formats that write no names cannot do this.
        let features = vec![Feature::new("x"), Feature { name: "y".to_owned(), unit: Some("m".to_owned()) }];
        let content = FileContent { sha256: String::new(), features, demonstrations: Vec::new() };
        let message = FromWorker::Read(vec![ReadFile { file: FileId(7), result: Ok(content) }]);
        assert_eq!(decode::<FromWorker>(&encode(&message)), Ok(message));
    }

    #[test]
    fn a_column_is_one_feature_over_time() {
        let values = vec![Some(1.0), Some(2.0), None, Some(4.0)];
        let track = Track { frames: 2, stride: 1, features: 2, values };
        assert_eq!(track.column(0).collect::<Vec<_>>(), [Some(1.0), None]);
        assert_eq!(track.column(1).collect::<Vec<_>>(), [Some(2.0), Some(4.0)]);
    }
}
