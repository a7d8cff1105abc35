//! Results and files, written whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::failure::Failure;

/// Prints `text` on standard output. A reader that went away, such as `head`, is no failure.
///
/// # Errors
///
/// When standard output cannot be written.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::io(Path::new("standard output"), &error))
        }
        _ => Ok(()),
    }
}

/// Prints `value` as indented JSON on standard output.
///
/// # Errors
///
/// When standard output cannot be written.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Failure::input(error.to_string()))?;
    print(&(text + "\n"))
}

/// Says `line` on standard error.
pub(crate) fn say(line: &str) {
    // There is nobody left to tell when this fails.
    let _ = writeln!(io::stderr(), "{line}");
}

/// Whether `path` stands for standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Refuses a file that [`write`] could not write, before any work is done for it.
///
/// # Errors
///
/// When `path` is a folder, or in a folder that does not exist.
pub(crate) fn refuse_impossible(path: &Path) -> Result<(), Failure> {
    if !is_standard(path) && (path.is_dir() || path.file_name().is_none()) {
        return Err(Failure::file(path, "it is a folder, not a file"));
    }
    let folder = folder_of(path);
    if !folder.is_dir() {
        return Err(Failure::file(path, format!("there is no folder {}", folder.display())));
    }
    Ok(())
}

/// Writes `text` into the file at `path`, or on standard output when `path` is `-`.
///
/// Until all of it is on the disk the file stays as it was: it is written beside and renamed.
///
/// # Errors
///
/// When the file cannot be written.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), Failure> {
    if is_standard(path) {
        return print(text);
    }
    // A link stays a link, and a device a device.
    let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let result = match fs::metadata(&target) {
        Ok(metadata) if !metadata.is_file() => fs::write(&target, text),
        _ => replace(&target, text),
    };
    result.map_err(|error| Failure::io(path, &error))
}

fn replace(target: &Path, text: &str) -> io::Result<()> {
    let temporary = temporary_beside(target);
    let written = write_new(&temporary, target, text).and_then(|()| fs::rename(&temporary, target));
    if written.is_err() {
        // What is left of it is of no use; why it failed is what matters.
        let _ = fs::remove_file(&temporary);
    }
    written
}

fn write_new(temporary: &Path, target: &Path, text: &str) -> io::Result<()> {
    let mut file: File = OpenOptions::new().write(true).create_new(true).open(temporary)?;
    if let Ok(metadata) = fs::metadata(target) {
        file.set_permissions(metadata.permissions())?;
    }
    file.write_all(text.as_bytes())?;
    file.sync_all()
}

fn temporary_beside(target: &Path) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    folder_of(target).join(format!(".{name}.{}.tmp", std::process::id()))
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// `1 word`, `2 words`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}

/// `a`, `a and b`, `a, b and c`.
pub(crate) fn list(items: &[String]) -> String {
    match items {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => items.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_as_a_whole_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        write(&path, "old").unwrap();
        write(&path, "new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write(&link, "new").unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }

    #[test]
    fn lists_and_counts_read_like_sentences() {
        let of = |items: &[&str]| list(&items.iter().map(|&item| item.to_owned()).collect::<Vec<_>>());
        assert_eq!(
            [of(&[]), of(&["a"]), of(&["a", "b"]), of(&["a", "b", "c"])],
            ["", "a", "a and b", "a, b and c"]
        );
        assert_eq!([count(0, "word"), count(1, "word")], ["0 words", "1 word"]);
    }
}
