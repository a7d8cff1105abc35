//! What is asked of the pool and what it answers. Values travel beside it. No browser here.

use std::sync::Arc;

use goalgraph::demonstration::{Demonstration, Feature};
use serde::{Deserialize, Serialize};

use super::piece::{Outcome, Piece};
use super::reading::Content;

/// What a worker of the pool is asked to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Task {
    /// Read the file beside this message.
    Read {
        /// What it is called.
        name: String,
    },
    /// Do a piece of an inference. The values that belong to it are beside this message.
    Infer(Box<Piece>),
}

/// What it answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Done {
    /// The file holds demonstrations, whose values are beside this message, one after the other.
    Demonstrations {
        /// SHA-256 of the file, hexadecimal.
        sha256: String,
        /// Their features.
        features: Vec<Feature>,
        /// Name and frames of each.
        names: Vec<(String, usize)>,
    },
    /// The file holds a specification: its text, or why it cannot be opened.
    Specification(Result<String, String>),
    /// What came of a piece of an inference.
    Inferred(Outcome),
    /// It cannot be done, for this reason.
    Refused(String),
}

impl Done {
    /// What was read, and the values that go beside it.
    pub(super) fn reading(content: Result<Content, String>) -> (Self, Vec<f64>) {
        match content {
            Err(reason) => (Self::Refused(reason), Vec::new()),
            Ok(Content::Specification(result)) => (Self::Specification(result), Vec::new()),
            Ok(Content::Demonstrations(demonstrations)) => {
                let first = demonstrations.first();
                let done = Self::Demonstrations {
                    sha256: first.map(|it| it.sha256().to_owned()).unwrap_or_default(),
                    features: first.map(|it| it.features().to_vec()).unwrap_or_default(),
                    names: demonstrations.iter().map(|it| (it.name().to_owned(), it.frames())).collect(),
                };
                let values: Vec<&[f64]> = demonstrations.iter().map(Demonstration::values).collect();
                (done, values.concat())
            }
        }
    }

    /// What was read, with the values that came beside it.
    ///
    /// # Errors
    ///
    /// When the file cannot be read.
    pub(super) fn into_content(self, values: Vec<f64>) -> Result<Content, String> {
        let (sha256, features, names) = match self {
            Self::Refused(reason) => return Err(reason),
            Self::Inferred(_) => return Err("it was not read".to_owned()),
            Self::Specification(result) => return Ok(Content::Specification(result)),
            Self::Demonstrations { sha256, features, names } => {
                (sha256, Arc::<[Feature]>::from(features), names)
            }
        };
        let demonstration = |name, values| {
            Demonstration::new(name, sha256.as_str(), Arc::clone(&features), values)
                .map_err(|error| error.to_string())
        };
        let demonstrations = match <[(String, usize); 1]>::try_from(names) {
            // There may be gigabytes: they are not copied.
            Ok([(name, _)]) => vec![demonstration(name, values)?],
            Err(names) => {
                let mut rest = values.as_slice();
                let next = |(name, frames): (String, usize)| {
                    let (own, others) = rest.split_at_checked(frames * features.len()).unwrap_or((rest, &[]));
                    rest = others;
                    demonstration(name, own.to_vec())
                };
                names.into_iter().map(next).collect::<Result<_, _>>()?
            }
        };
        Ok(Content::Demonstrations(demonstrations))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::{decode, encode};
    use crate::worker::reading::read;

    /// Name, digest and values of each demonstration, after the way through the messages where `sent`.
    fn read_all(file: &str, sent: bool) -> Vec<(String, String, Vec<Option<f64>>)> {
        let mut content = read("take.csv", file.as_bytes(), None);
        if sent {
            let (done, values) = Done::reading(content);
            content = decode::<Done>(&encode(&done)).unwrap().into_content(values);
        }
        let Ok(Content::Demonstrations(demonstrations)) = content else { panic!("no demonstrations") };
        let defined = |value: &f64| (!value.is_nan()).then_some(*value);
        let all = |it: &Demonstration| {
            (it.name().to_owned(), it.sha256().to_owned(), it.values().iter().map(defined).collect())
        };
        demonstrations.iter().map(all).collect()
    }

    #[test]
    fn demonstrations_are_the_same_after_the_way_between_workers() {
        for file in ["red.x [m],red.y\n1,\n0.1,3e-7\n", "demo,x\na,1\na,\nb,3\n"] {
            assert_eq!(read_all(file, true), read_all(file, false), "{file}");
        }
        assert_eq!(read_all("demo,x\na,1\na,\nb,3\n", true).len(), 2);
    }

    #[test]
    fn a_reason_and_a_specification_are_the_same_after_the_way_between_workers() {
        let sent = |name, bytes| Done::reading(read(name, bytes, None)).0.into_content(Vec::new());
        assert_eq!(sent("x.csv", b"x\na\n").err(), read("x.csv", b"x\na\n", None).err());
        assert!(matches!(sent("x.dot", b"\xff"), Ok(Content::Specification(Err(_)))));
    }

    #[test]
    fn values_that_are_too_few_are_refused() {
        let (done, mut values) = Done::reading(read("x.csv", b"demo,x\n0,1\n1,2\n", None));
        values.pop();
        assert!(done.into_content(values).is_err());
    }
}
