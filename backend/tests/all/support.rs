//! A folder of files, and the real program run in it.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

/// A temporary folder to run the program in.
pub(crate) struct Bench {
    folder: tempfile::TempDir,
}

/// How the program ended.
#[derive(Debug)]
pub(crate) struct Ended {
    /// Exit status.
    pub(crate) status: i32,
    /// Standard output.
    pub(crate) stdout: String,
    /// Standard error.
    pub(crate) stderr: String,
}

impl Bench {
    /// An empty folder.
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    /// Writes a file, and the folders it is in.
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    /// Where a file is.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The content of a file.
    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// The names of the files in the folder.
    pub(crate) fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Runs `goalgraph` with these arguments in the folder.
    pub(crate) fn run(&self, arguments: &[&str]) -> Ended {
        let mut command = Command::new(env!("CARGO_BIN_EXE_goalgraph"));
        let Output { status, stdout, stderr } =
            command.args(arguments).current_dir(self.folder.path()).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Ended { status: status.code().unwrap(), stdout: text(stdout), stderr: text(stderr) }
    }

    /// Runs `goalgraph`, which must succeed, and returns its standard output.
    pub(crate) fn succeed(&self, arguments: &[&str]) -> String {
        let ended = self.run(arguments);
        assert_eq!(ended.status, 0, "{ended:?}");
        ended.stdout
    }

    /// Runs `goalgraph`, which must end with `status`, nothing on standard output and these lines on standard error.
    pub(crate) fn fail(&self, arguments: &[&str], status: i32, lines: &[&str]) {
        let ended = self.run(arguments);
        assert_eq!(ended.status, status, "{ended:?}");
        assert_eq!(ended.stderr.lines().collect::<Vec<_>>(), lines);
        assert_eq!(ended.stdout, "");
    }
}

/// Six orders of two stacks, each with two blocks: a block may be put down once the one below it is.
pub(crate) const TWO_STACKS: &str = "\
red-1 green-1 yellow-1 blue-1
red-1 green-1 yellow-1 blue-1
red-1 green-1 yellow-1 blue-1
red-1 yellow-1 green-1 blue-1
red-1 yellow-1 blue-1 green-1
yellow-1 red-1 green-1 blue-1
yellow-1 red-1 blue-1 green-1
yellow-1 blue-1 red-1 green-1
";
