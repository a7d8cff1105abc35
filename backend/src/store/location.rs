//! Where a store is.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

use sqlx::postgres::PgConnectOptions;

/// Where a store keeps its database and its files.
#[derive(Clone, PartialEq, Eq)]
pub struct Location {
    /// The folder of the demonstration files, and of the database unless it is elsewhere.
    pub data: PathBuf,
    /// URL of a PostgreSQL database; without it the database is SQLite in the folder. It may hold a password: what is
    /// shown of a location never does.
    pub database: Option<String>,
}

impl Location {
    /// A folder with an SQLite database in it.
    pub fn folder(data: impl Into<PathBuf>) -> Self {
        Self { data: data.into(), database: None }
    }
}

/// The folder; or the host and the name of the PostgreSQL database.
impl fmt::Display for Location {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(url) = &self.database else {
            return write!(formatter, "{}", self.data.display());
        };
        match PgConnectOptions::from_str(url) {
            Ok(options) => {
                let name = options.get_database().unwrap_or("of the user's name");
                write!(formatter, "the PostgreSQL database {name} at {}", options.get_host())
            }
            // What cannot be parsed may have its password anywhere.
            Err(_) => formatter.write_str("the PostgreSQL database"),
        }
    }
}

impl fmt::Debug for Location {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Location({self})")
    }
}

/// How a store is opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StoreOptions {
    /// Whether a data folder and a database are made where there are none.
    pub create: bool,
    /// How long a write waits for another program that has the database locked.
    pub busy_timeout: Duration,
    /// The most pages (of 4096 bytes) that an SQLite database may take, or no limit but the disk.
    pub max_pages: Option<u32>,
}

impl Default for StoreOptions {
    fn default() -> Self {
        Self { create: true, busy_timeout: Duration::from_secs(5), max_pages: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_location_never_shows_a_password() {
        let shown = |url: &str| {
            let location = Location { data: PathBuf::from("data"), database: Some(url.to_owned()) };
            format!("{location} {location:?}")
        };
        for url in [
            "postgres://me:hunter2@db.example/robots",
            "postgres://db.example/robots?user=me&password=hunter2",
            "postgres://me:hunter2@:x/",
            "hunter2",
        ] {
            assert!(!shown(url).contains("hunter2"), "{}", shown(url));
        }
        let location = "the PostgreSQL database robots at db.example";
        assert!(shown("postgres://me:hunter2@db.example/robots").starts_with(location));
        assert_eq!(Location::folder("data").to_string(), "data");
    }
}
