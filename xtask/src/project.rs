//! Where the source, the build results and the tools lie.

use std::env;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// The folders that every subcommand works in.
pub(crate) struct Project {
    /// The workspace's root.
    pub(crate) root: PathBuf,
    /// Cargo's target folder for native builds.
    pub(crate) target: PathBuf,
    /// Tools that this project installs for itself, shared by all its checkouts.
    pub(crate) cache: PathBuf,
}

impl Project {
    /// Finds the folders and makes the cache folder.
    ///
    /// The cache is `$GOALGRAPH_CACHE`, else `goalgraph` in the user's cache folder.
    ///
    /// # Errors
    ///
    /// When there is no home folder, or the cache folder cannot be made.
    pub(crate) fn find() -> Result<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"))
            .parent()
            .context("xtask is not inside the workspace it was built from")?
            .to_path_buf();
        let target = folder_from("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |it| root.join(it));
        let cache = match folder_from("GOALGRAPH_CACHE") {
            Some(folder) => std::path::absolute(folder)?,
            None => user_cache()?.join("goalgraph"),
        };
        std::fs::create_dir_all(&cache).with_context(|| {
            format!("cannot make {}: set GOALGRAPH_CACHE to a folder you can write in", cache.display())
        })?;
        Ok(Self { root, target, cache })
    }

    /// The folder of the built app.
    pub(crate) fn dist(&self) -> PathBuf {
        self.root.join("dist")
    }

    /// The folder of the browser tests.
    pub(crate) fn e2e(&self) -> PathBuf {
        self.root.join("e2e")
    }

    /// The folder of the Python executor.
    pub(crate) fn python_executor(&self) -> PathBuf {
        self.root.join("executors/python")
    }
}

fn user_cache() -> Result<PathBuf> {
    folder_from("XDG_CACHE_HOME")
        .or_else(|| folder_from("HOME").map(|home| home.join(".cache")))
        .context("there is no home folder: set GOALGRAPH_CACHE to a folder for the build tools")
}

fn folder_from(variable: &str) -> Option<PathBuf> {
    env::var_os(variable).filter(|value| !value.is_empty()).map(PathBuf::from)
}
