//! How a command fails.

use std::fmt::Display;
use std::io;
use std::path::Path;

/// Why a command did nothing, or stopped.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// The input is wrong: one line per fault, with its place. There may be no line when all was said already.
    Input(Vec<String>),
    /// The arguments do not go together: one sentence.
    Usage(String),
}

impl Failure {
    /// A single fault.
    pub(crate) fn input(line: impl Into<String>) -> Self {
        Self::Input(vec![line.into()])
    }

    /// A single fault of a file.
    pub(crate) fn file(path: &Path, message: impl Display) -> Self {
        Self::input(format!("{}: {message}", path.display()))
    }

    /// A file that cannot be read or written.
    pub(crate) fn io(path: &Path, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::file(path, "there is no such file or folder"),
            io::ErrorKind::PermissionDenied => Self::file(path, "permission denied"),
            io::ErrorKind::IsADirectory => Self::file(path, "it is a folder, not a file"),
            _ => Self::file(path, error),
        }
    }

    /// What to say on standard error.
    pub(crate) fn lines(&self) -> &[String] {
        match self {
            Self::Input(lines) => lines,
            Self::Usage(line) => std::slice::from_ref(line),
        }
    }

    /// The program's exit status.
    pub(crate) fn exit_status(&self) -> u8 {
        match self {
            Self::Input(_) => 1,
            Self::Usage(_) => 2,
        }
    }
}
