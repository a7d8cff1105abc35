//! Files in: demonstrations, words and specifications.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, Words, import, import_words};
use goalgraph::specification::Specification;

use crate::failure::Failure;
use crate::output::is_standard;
use crate::progress::Progress;

/// The demonstrations of one file.
pub(crate) struct Recording {
    /// The file.
    pub(crate) path: PathBuf,
    /// What it holds, at least one.
    pub(crate) demonstrations: Vec<Demonstration>,
}

/// Endings of the demonstration files in a folder.
const ENDINGS: [&str; 4] = ["csv", "tsv", "txt", "json"];

/// Reads the demonstrations in `paths`, which may be folders: of these the files with a known ending.
///
/// The files are in the byte order of their names, wherever they lie, as in the browser, which sees no folders.
///
/// # Errors
///
/// One line for each file that is no demonstration; nothing of the others is returned then.
pub(crate) fn read_demonstrations(
    paths: &[PathBuf],
    header: Header,
    progress: &Progress,
) -> Result<Vec<Recording>, Failure> {
    let mut recordings = Vec::new();
    let mut faults = Vec::new();
    let files = demonstration_files(paths).unwrap_or_else(|(files, lines)| {
        faults = lines;
        files
    });
    let total = files.len();
    for (index, path) in files.into_iter().enumerate() {
        progress.stage(format!("Reading {} (file {} of {total})", path.display(), index + 1));
        match read_recording(path, header) {
            Ok(recording) => recordings.push(recording),
            Err(failure) => faults.extend_from_slice(failure.lines()),
        }
    }
    if faults.is_empty() { Ok(recordings) } else { Err(Failure::Input(faults)) }
}

fn read_recording(path: PathBuf, header: Header) -> Result<Recording, Failure> {
    let bytes = fs::read(&path).map_err(|error| Failure::io(&path, &error))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let demonstrations = import(&name, &bytes, header).map_err(|error| Failure::file(&path, error))?;
    Ok(Recording { path, demonstrations })
}

/// The files that `paths` stand for, each once; or those that there are, and one line for each path that is none.
fn demonstration_files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, (Vec<PathBuf>, Vec<String>)> {
    let mut files = Vec::new();
    let mut faults = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        match files_in(path) {
            Ok(found) => files.extend(found),
            Err(failure) => faults.extend_from_slice(failure.lines()),
        }
    }
    files.sort_by(|a, b| key(a).cmp(&key(b)));
    let mut seen = BTreeSet::new();
    files.retain(|path| seen.insert(path.canonicalize().unwrap_or_else(|_| path.clone())));
    if faults.is_empty() { Ok(files) } else { Err((files, faults)) }
}

fn key(path: &Path) -> (&[u8], &Path) {
    (path.file_name().unwrap_or_default().as_encoded_bytes(), path)
}

fn files_in(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let failure = |error: io::Error| Failure::io(folder, &error);
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(failure)? {
        let path = entry.map_err(failure)?.path();
        if path.is_file() && may_be_demonstration(&path) {
            files.push(path);
        }
    }
    if files.is_empty() {
        return Err(Failure::file(folder, "there is no .csv, .tsv, .txt or .json file in this folder"));
    }
    Ok(files)
}

/// Whether a file in a folder is meant as a demonstration, from its name.
fn may_be_demonstration(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let ending = path.extension().and_then(OsStr::to_str).unwrap_or_default().to_lowercase();
    let is_about_others = name.starts_with("readme") || name.starts_with("license");
    ENDINGS.contains(&ending.as_str())
        && !name.starts_with('.')
        && !is_about_others
        && !name.ends_with(".goalgraph.json")
}

/// Reads the words in the file at `path`.
///
/// # Errors
///
/// One line when it cannot be read or is no file of words.
pub(crate) fn read_words(path: &Path) -> Result<Words, Failure> {
    let bytes = read(path).map_err(|error| Failure::io(path, &error))?;
    import_words(&bytes).map_err(|error| Failure::file(path, error))
}

/// Reads the specification in the file at `path`.
///
/// # Errors
///
/// One line when it cannot be read, is no specification, or contradicts itself.
pub(crate) fn read_specification(path: &Path) -> Result<Specification, Failure> {
    let bytes = read(path).map_err(|error| Failure::io(path, &error))?;
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        let line = bytes[..error.valid_up_to()].split(|&byte| byte == b'\n').count();
        Failure::file(path, format!("line {line}: it is no UTF-8 text; a specification is JSON"))
    })?;
    Specification::from_json(text).map_err(|error| Failure::file(path, error))
}

/// The bytes of a file, or of standard input for `-`.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    if !is_standard(path) {
        return fs::read(path);
    }
    let mut bytes = Vec::new();
    io::stdin().lock().read_to_end(&mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_folder_only_what_may_be_a_demonstration_is_read() {
        let check =
            |name: &str, expected| assert_eq!(may_be_demonstration(Path::new(name)), expected, "{name}");
        check("a/demo.csv", true);
        check("a/demo.TSV", true);
        check("a/demo.json", true);
        check("a/task.goalgraph.json", false);
        check("a/README.txt", false);
        check("a/LICENSE.txt", false);
        check("a/.demo.csv", false);
        check("a/demo.png", false);
    }

    #[test]
    fn files_are_in_the_order_of_their_names_and_each_is_there_once() {
        let paths = ["b/2.csv", "a/3.csv", "c/1.csv", "a/3.csv", "a/1.csv"].map(PathBuf::from);
        let expected = ["a/1.csv", "c/1.csv", "b/2.csv", "a/3.csv"].map(PathBuf::from);
        assert_eq!(demonstration_files(&paths).unwrap(), expected);
    }
}
