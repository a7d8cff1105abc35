//! Which files take part in the inference, and why the others do not.

use std::sync::Arc;

use goalgraph::demonstration::Feature;

use super::model::{LoadedFile, Reading};
use crate::protocol::{FileContent, FileId};

/// What became of a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// It is not read yet.
    Reading,
    /// Its reading was canceled.
    Canceled,
    /// It takes part.
    Accepted(Arc<FileContent>),
    /// It does not, for this reason.
    Refused(String),
}

/// The verdict on every file, in the order of `files`. The first readable file says which features the others must have.
pub(crate) fn verdicts(files: &[LoadedFile]) -> Vec<(FileId, Verdict)> {
    let reference = files.iter().find_map(|file| match &file.reading {
        Reading::Read(content) => Some((file.name.as_str(), &content.features)),
        _ => None,
    });
    let verdict = |file: &LoadedFile| match &file.reading {
        Reading::Waiting => Verdict::Reading,
        Reading::Canceled => Verdict::Canceled,
        Reading::Refused(reason) => Verdict::Refused(reason.clone()),
        Reading::Read(content) => {
            let difference =
                reference.and_then(|(name, features)| difference(features, &content.features, name));
            difference.map_or_else(|| Verdict::Accepted(Arc::clone(content)), Verdict::Refused)
        }
    };
    files.iter().map(|file| (file.id, verdict(file))).collect()
}

/// How `features` differ from the `known` ones of the file called `name`, as a sentence; none when they are the same.
fn difference(known: &[Feature], features: &[Feature], name: &str) -> Option<String> {
    let missing = names_only_in(known, features);
    let added = names_only_in(features, known);
    let differences: Vec<String> = [("does not have", missing), ("also has", added)]
        .into_iter()
        .filter(|(_, names)| !names.is_empty())
        .map(|(verb, names)| format!("{verb} {}", enumerate(&names)))
        .collect();
    (!differences.is_empty())
        .then(|| format!("its features are not those of {name}: it {}", differences.join(" and ")))
}

fn names_only_in<'a>(these: &'a [Feature], others: &[Feature]) -> Vec<&'a str> {
    let unknown = |feature: &&Feature| others.iter().all(|other| other.name != feature.name);
    these.iter().filter(unknown).map(|feature| feature.name.as_str()).collect()
}

/// Up to three names, and how many more there are.
fn enumerate(names: &[&str]) -> String {
    const SHOWN: usize = 3;
    let shown = names[..names.len().min(SHOWN)].join(", ");
    match names.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(id: u32, features: &[&str]) -> LoadedFile {
        let features = features.iter().map(|name| Feature::new(*name)).collect();
        let content = FileContent { sha256: String::new(), features, demonstrations: Vec::new() };
        let reading = Reading::Read(Arc::new(content));
        LoadedFile { id: FileId(id), name: format!("{id}.csv"), bytes: 0.0, reading }
    }

    fn reasons(files: &[LoadedFile]) -> Vec<Option<String>> {
        let reason = |(_, verdict)| match verdict {
            Verdict::Refused(reason) => Some(reason),
            _ => None,
        };
        verdicts(files).into_iter().map(reason).collect()
    }

    #[test]
    fn the_same_features_in_another_order_are_accepted() {
        assert_eq!(reasons(&[file(0, &["x", "y"]), file(1, &["y", "x"])]), [None, None]);
    }

    #[test]
    fn a_file_with_other_features_is_refused_with_the_difference() {
        let reasons = reasons(&[file(0, &["x", "y"]), file(1, &["x", "z"]), file(2, &["x", "y"])]);
        let expected = "its features are not those of 0.csv: it does not have y and also has z";
        assert_eq!(reasons, [None, Some(expected.to_owned()), None]);
    }

    #[test]
    fn a_file_that_cannot_be_read_does_not_decide_for_the_others() {
        let bad = LoadedFile { reading: Reading::Refused("line 2: no".to_owned()), ..file(0, &[]) };
        assert_eq!(reasons(&[bad, file(1, &["x"])]), [Some("line 2: no".to_owned()), None]);
    }

    #[test]
    fn many_missing_features_are_counted() {
        let reasons = reasons(&[file(0, &["a", "b", "c", "d", "e"]), file(1, &["a"])]);
        let expected = "its features are not those of 0.csv: it does not have b, c, d and 1 more";
        assert_eq!(reasons[1].as_deref(), Some(expected));
    }
}
