//! A place for a store of one test, on either kind of database.

use std::env;
use std::future::Future;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

use goalgraph_server::store::{
    ApprovalRow, Backend, Location, NewApproval, NewRevision, NewRun, Signature, SpecificationRow, Store,
    StoreError, StoreOptions,
};
use sqlx::any::AnyConnectOptions;
use sqlx::{AnyConnection, AssertSqlSafe, ConnectOptions, Executor};

/// Names the URL of a PostgreSQL database of a user who may create databases.
const POSTGRES: &str = "GOALGRAPH_TEST_POSTGRES";

/// Runs each of these test bodies on every kind of database.
macro_rules! on_every_database {
    ($($name:ident),+ $(,)?) => {
        mod sqlite {
            $(#[test] fn $name() {
                $crate::store::place::run(goalgraph_server::store::Backend::Sqlite, super::$name);
            })+
        }
        mod postgres {
            $(#[test] fn $name() {
                $crate::store::place::run(goalgraph_server::store::Backend::Postgres, super::$name);
            })+
        }
    };
}
pub(crate) use on_every_database;

/// An empty data folder, and an empty database of its own when that is PostgreSQL.
pub(crate) struct Place {
    pub(crate) backend: Backend,
    pub(crate) folder: tempfile::TempDir,
    database: Option<String>,
}

/// Runs a test body in a place of its own, which is gone after, however the test ends.
pub(crate) fn run<F>(backend: Backend, body: impl FnOnce(Arc<Place>) -> F)
where
    F: Future<Output = ()> + 'static,
{
    sqlx::any::install_default_drivers();
    let test = async {
        let place = Arc::new(Place::create(backend).await);
        let ended = tokio::task::spawn_local(body(place.clone())).await;
        place.remove().await;
        if let Err(error) = ended {
            std::panic::resume_unwind(error.into_panic());
        }
    };
    tokio::runtime::Runtime::new().unwrap().block_on(tokio::task::LocalSet::new().run_until(test));
}

impl Place {
    async fn create(backend: Backend) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let database = match backend {
            Backend::Sqlite => None,
            Backend::Postgres => Some(create_database().await),
        };
        Self { backend, folder, database }
    }

    /// The data folder.
    pub(crate) fn data(&self) -> PathBuf {
        self.folder.path().join("data")
    }

    /// Where the store is.
    pub(crate) fn location(&self) -> Location {
        Location { data: self.data(), database: self.database.as_ref().map(|name| url_of(name)) }
    }

    /// Arguments that name the store on the command line.
    pub(crate) fn arguments(&self) -> Vec<String> {
        let data = self.data().into_os_string().into_string().unwrap();
        let mut arguments = vec!["--data".to_owned(), data];
        if let Some(url) = self.location().database {
            arguments.extend(["--database".to_owned(), url]);
        }
        arguments
    }

    /// Opens the store, which waits a tenth of a second for a locked database.
    pub(crate) async fn open(&self) -> Store {
        self.try_open().await.unwrap()
    }

    /// As [`Place::open`].
    pub(crate) async fn try_open(&self) -> Result<Store, StoreError> {
        let busy_timeout = Duration::from_millis(100);
        Store::open(&self.location(), StoreOptions { busy_timeout, ..StoreOptions::default() }).await
    }

    /// A connection to the database, past the store.
    pub(crate) async fn connect(&self) -> AnyConnection {
        let url = match &self.database {
            Some(name) => url_of(name),
            None => format!("sqlite://{}?mode=rwc", self.data().join("goalgraph.sqlite").display()),
        };
        AnyConnectOptions::from_str(&url).unwrap().connect().await.unwrap()
    }

    /// Does to the database what the store never would.
    pub(crate) async fn damage(&self, statement: &str) {
        let mut connection = self.connect().await;
        if self.backend == Backend::Sqlite {
            connection.execute("PRAGMA foreign_keys = OFF").await.unwrap();
        }
        connection.execute(AssertSqlSafe(statement.to_owned())).await.unwrap();
    }

    async fn remove(&self) {
        if let Some(name) = &self.database {
            execute(format!("DROP DATABASE {name} WITH (FORCE)")).await;
        }
    }
}

fn server() -> String {
    env::var(POSTGRES).unwrap_or_else(|_| {
        panic!("{POSTGRES} is not set: run `cargo xtask test`, which starts a PostgreSQL for this test, or set it to the URL of one")
    })
}

/// The server's URL with another database's name in it.
fn url_of(database: &str) -> String {
    let server = server();
    let (address, options) = server.split_once('?').unwrap_or((&server, ""));
    let (address, _) = address.rsplit_once('/').unwrap();
    format!("{address}/{database}?{options}")
}

async fn create_database() -> String {
    let name = format!("goalgraph_{}", uuid::Uuid::new_v4().simple());
    execute(format!("CREATE DATABASE {name}")).await;
    name
}

async fn execute(statement: String) {
    let mut connection = AnyConnectOptions::from_str(&server()).unwrap().connect().await.unwrap();
    connection.execute(AssertSqlSafe(statement)).await.unwrap();
}

/// A revision by Ada with this content.
pub(crate) fn revision(content: &str) -> NewRevision {
    NewRevision {
        content: content.to_owned(),
        name: "Two stacks".to_owned(),
        author: "Ada".to_owned(),
        message: format!("saved {content}"),
        saved_at_ms: 1_000,
        positions: None,
    }
}

/// A signature at a time.
pub(crate) fn signature(who: &str, at_ms: i64) -> Signature {
    let (meaning, comment) = ("for the robot".to_owned(), String::new());
    Signature { who: who.to_owned(), token: None, meaning, comment, at_ms }
}

/// Approves a revision where another was expected to be the approved one.
pub(crate) async fn approve(
    store: &Store,
    id: &str,
    revision: u64,
    expected_approved: Option<u64>,
    signature: Signature,
) -> Result<ApprovalRow, StoreError> {
    let sha256_seen = store.revision(id, revision).await?.sha256;
    store.approve(id, NewApproval { revision, sha256_seen, expected_approved, signature }).await
}

/// A run of a specification's first revision.
pub(crate) fn run_of(specification: &SpecificationRow, id: &str) -> NewRun {
    NewRun {
        id: id.to_owned(),
        executor: "arm 1".to_owned(),
        specification: specification.id.clone(),
        revision: 1,
        sha256: specification.sha256.clone(),
        at_ms: 1_000,
    }
}
