//! Which store a command works on.

use std::env;
use std::ffi::OsString;
use std::future::Future;
use std::path::PathBuf;

use clap::Args;
use goalgraph_server::store::{Location, Store, StoreError, StoreOptions};
use tokio::runtime::Runtime;

use crate::failure::Failure;

/// Arguments of every command that works on what the server keeps.
#[derive(Args)]
pub(crate) struct StoreArguments {
    /// Folder of what is kept; without it a folder of yours, such as ~/.local/share/goalgraph
    #[arg(long, value_name = "DIR", env = "GOALGRAPH_DATA")]
    data: Option<PathBuf>,
    /// A PostgreSQL database instead of SQLite in the folder; the environment shows its password to fewer people
    #[arg(
        long,
        value_name = "postgres://USER:PASSWORD@HOST/NAME",
        env = "GOALGRAPH_DATABASE",
        hide_env_values = true
    )]
    database: Option<String>,
}

impl StoreArguments {
    /// Where the store is.
    ///
    /// # Errors
    ///
    /// When no folder is named and there is no home folder.
    pub(crate) fn location(&self) -> Result<Location, Failure> {
        let no_home =
            || Failure::Usage("error: there is no home folder; name a folder with --data".to_owned());
        let own = || default_folder(|name| env::var_os(name)).ok_or_else(no_home);
        let data = self.data.clone().map_or_else(own, Ok)?;
        Ok(Location { data, database: self.database.clone() })
    }

    /// The arguments that name the same store in another command: never a URL, which may hold a password.
    pub(crate) fn again(&self) -> String {
        let data = self.data.as_ref().map(|data| format!(" --data {}", data.display()));
        let database = self.database.as_ref().map(|_| " --database URL".to_owned());
        data.into_iter().chain(database).collect()
    }

    /// Opens the store, does `task` with it and closes it.
    ///
    /// # Errors
    ///
    /// When there is no such store, or `task` fails; the line begins with the store's place.
    pub(crate) fn with_store<T, F>(
        &self,
        options: StoreOptions,
        task: impl FnOnce(Store) -> F,
    ) -> Result<T, Failure>
    where
        F: Future<Output = Result<T, StoreError>>,
    {
        let location = self.location()?;
        let failure = |error: StoreError| Failure::input(line(&location, &error));
        let runtime = Runtime::new().map_err(|error| Failure::input(error.to_string()))?;
        runtime.block_on(async {
            let store = Store::open(&location, options).await.map_err(failure)?;
            let result = task(store.clone()).await;
            store.close().await;
            result.map_err(failure)
        })
    }
}

/// What is said of an error: with the store's place, unless that or another place is in it.
fn line(location: &Location, error: &StoreError) -> String {
    match error {
        StoreError::NoDatabase(_) | StoreError::Io { .. } | StoreError::Invalid(_) => error.to_string(),
        _ => format!("{location}: {error}"),
    }
}

/// The folder for a user's data on this system, from the environment's variables.
fn default_folder(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    let folder = |name: &str| variable(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let parent = if cfg!(windows) {
        folder("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        folder("HOME").map(|home| home.join("Library/Application Support"))
    } else {
        // A relative path is none: https://specifications.freedesktop.org/basedir-spec/latest/
        let data = folder("XDG_DATA_HOME").filter(|path| path.is_absolute());
        data.or_else(|| folder("HOME").map(|home| home.join(".local/share")))
    };
    parent.map(|parent| parent.join("goalgraph"))
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn without_a_folder_the_users_own_is_taken() {
        let folder = |variables: &[(&str, &str)]| {
            default_folder(|name| {
                variables.iter().find(|(it, _)| *it == name).map(|(_, value)| OsString::from(value))
            })
        };
        let home = ("HOME", "/home/me");
        assert_eq!(folder(&[home]), Some(PathBuf::from("/home/me/.local/share/goalgraph")));
        assert_eq!(folder(&[home, ("XDG_DATA_HOME", "/data")]), Some(PathBuf::from("/data/goalgraph")));
        assert_eq!(folder(&[home, ("XDG_DATA_HOME", "data")]), folder(&[home]));
        assert_eq!(folder(&[]), None);
    }
}
