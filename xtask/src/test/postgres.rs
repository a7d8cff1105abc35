//! A PostgreSQL of the tests' own: made for one run of them, reached through a socket in its folder, and gone after.

use std::env;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use anyhow::{Context, Result, bail};

use crate::process::{first_line, run_quietly};

/// The variable through which the tests learn its URL.
pub(super) const VARIABLE: &str = "GOALGRAPH_TEST_POSTGRES";

/// How long it may take to start on a busy machine.
const PATIENCE: Duration = Duration::from_mins(1);

/// Nothing of it outlives the tests, so nothing needs to be on the disk.
const SETTINGS: [&str; 5] = [
    "listen_addresses=",
    "fsync=off",
    "synchronous_commit=off",
    "full_page_writes=off",
    "max_connections=300",
];

/// A running database server; dropped, it is stopped and its folder removed.
pub(super) struct Postgres {
    server: Child,
    folder: Folder,
}

/// A folder that is removed when it is dropped.
struct Folder(PathBuf);

impl Postgres {
    /// Starts a server with the programs in the folder `programs`.
    ///
    /// # Errors
    ///
    /// When it cannot be made or does not start; its log is in the message then.
    pub(super) fn start(programs: &Path) -> Result<Self> {
        let folder = Folder::create()?;
        let data = folder.0.join("data");
        let user = User::for_server(&folder.0)?;
        let mut initdb = Command::new(programs.join("initdb"));
        initdb.args(["--no-sync", "--auth=trust", "--username=postgres", "--encoding=UTF8", "--locale=C"]);
        run_quietly(user.run(initdb.arg("--pgdata").arg(&data)))
            .context("cannot make a PostgreSQL database")?;

        let log = File::create(folder.0.join("log")).context("cannot make the log of PostgreSQL")?;
        let mut server = Command::new(programs.join("postgres"));
        server.arg("-D").arg(&data).arg("-k").arg(&folder.0);
        server.args(SETTINGS.iter().flat_map(|setting| ["-c", setting]));
        server.stdin(Stdio::null()).stdout(log.try_clone()?).stderr(log);
        let server = user.run(&mut server).spawn().context("cannot start PostgreSQL")?;
        let mut postgres = Self { server, folder };
        postgres.wait_until_ready(&data)?;
        Ok(postgres)
    }

    /// Its URL, for the one superuser.
    pub(super) fn url(&self) -> String {
        let encode = |byte: u8| match byte {
            b'/' | b'-' | b'_' | b'.' => char::from(byte).to_string(),
            _ if byte.is_ascii_alphanumeric() => char::from(byte).to_string(),
            _ => format!("%{byte:02X}"),
        };
        let folder: String = self.folder.0.to_string_lossy().bytes().map(encode).collect();
        format!("postgres://postgres@localhost/postgres?host={folder}")
    }

    /// The server writes how it is doing into the last line of a file.
    fn wait_until_ready(&mut self, data: &Path) -> Result<()> {
        let started = Instant::now();
        loop {
            let status = fs::read_to_string(data.join("postmaster.pid")).unwrap_or_default();
            if status.lines().nth(7).is_some_and(|line| line.trim() == "ready") {
                return Ok(());
            }
            if self.server.try_wait()?.is_some() || started.elapsed() > PATIENCE {
                let log = fs::read_to_string(self.folder.0.join("log")).unwrap_or_default();
                bail!("PostgreSQL does not start:\n{log}");
            }
            thread::sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Postgres {
    fn drop(&mut self) {
        // SIGQUIT ends it with its children, at once; what it leaves in its folder is removed with that.
        let told = Command::new("kill").arg("-QUIT").arg(self.server.id().to_string()).status();
        if told.is_ok_and(|status| status.success()) {
            let _ = self.server.wait();
        }
    }
}

impl Folder {
    /// In the folder for temporary files: a server that is not run by root cannot reach root's own folders, and a socket's
    /// path must be short.
    fn create() -> Result<Self> {
        let started = SystemTime::now().duration_since(UNIX_EPOCH)?.as_micros();
        let path = env::temp_dir().join(format!("goalgraph-postgres-{}-{started}", std::process::id()));
        fs::create_dir(&path).with_context(|| format!("cannot make {}", path.display()))?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if let Err(error) = fs::remove_dir_all(&self.0) {
            eprintln!("warning: {}: {error}", self.0.display());
        }
    }
}

/// Who the server runs as: it refuses to be run by root, and is run by the user of its package then.
struct User(Option<(u32, u32)>);

impl User {
    /// The user, who can write in `folder`.
    fn for_server(folder: &Path) -> Result<Self> {
        if id(&["-u"])? != 0 {
            return Ok(Self(None));
        }
        let no_user =
            "PostgreSQL refuses to be run by root, and there is no user `postgres` to run it instead";
        let user = id(&["-u", "postgres"]).context(no_user)?;
        let group = id(&["-g", "postgres"]).context(no_user)?;
        own(folder, user, group)?;
        Ok(Self(Some((user, group))))
    }

    #[cfg(unix)]
    fn run<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        use std::os::unix::process::CommandExt;
        if let Some((user, group)) = self.0 {
            command.uid(user).gid(group);
        }
        command.current_dir("/")
    }

    #[cfg(not(unix))]
    fn run<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command
    }
}

#[cfg(unix)]
fn own(folder: &Path, user: u32, group: u32) -> Result<()> {
    std::os::unix::fs::chown(folder, Some(user), Some(group))
        .with_context(|| format!("cannot give {} to the user postgres", folder.display()))
}

#[cfg(not(unix))]
fn own(_: &Path, _: u32, _: u32) -> Result<()> {
    Ok(())
}

/// A number that `id` prints.
fn id(arguments: &[&str]) -> Result<u32> {
    let printed = first_line(Command::new("id").args(arguments)).context("`id` fails")?;
    printed.parse().with_context(|| format!("`id` printed {printed}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::postgres::find;

    #[test]
    fn a_server_answers_while_it_is_held_and_is_gone_after() {
        let programs = find().expect("PostgreSQL is missing: run `cargo xtask setup`");
        let postgres = Postgres::start(&programs).expect("it starts");
        let query = |url: &str| {
            let mut psql = Command::new(programs.join("psql"));
            first_line(psql.args(["--no-psqlrc", "-tAc", "SELECT 6 * 7"]).arg(url))
        };
        let (url, folder) = (postgres.url(), postgres.folder.0.clone());
        assert_eq!(query(&url).as_deref(), Some("42"));
        drop(postgres);
        assert!(!folder.exists() && query(&url).is_none());
    }
}
