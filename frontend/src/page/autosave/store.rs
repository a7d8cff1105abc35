//! Texts and files in the browser's database, by name.

use idb::builder::{DatabaseBuilder, ObjectStoreBuilder};
use idb::{Database, Error, Query, TransactionMode};
use wasm_bindgen::JsValue;

const NAME: &str = "goalgraph";
/// Version of the database's stores; what is in them has versions of its own.
const VERSION: u32 = 1;

/// What a name is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shelf {
    /// Texts: the work, and work that could not be read.
    Work,
    /// Recordings.
    Files,
}

impl Shelf {
    fn name(self) -> &'static str {
        match self {
            Self::Work => "work",
            Self::Files => "files",
        }
    }
}

/// The database. A browser may refuse it, in a private window for one.
pub(super) struct Store(Database);

impl Store {
    /// Opens the database, and makes it where there is none.
    pub(super) async fn open() -> Result<Self, Error> {
        let shelf = |shelf: Shelf| ObjectStoreBuilder::new(shelf.name());
        let builder = DatabaseBuilder::new(NAME).version(VERSION);
        let builder = builder.add_object_store(shelf(Shelf::Work)).add_object_store(shelf(Shelf::Files));
        Ok(Self(builder.build().await?))
    }

    /// What is kept under a name.
    pub(super) async fn get(&self, shelf: Shelf, name: &str) -> Result<Option<JsValue>, Error> {
        let transaction = self.0.transaction(&[shelf.name()], TransactionMode::ReadOnly)?;
        transaction.object_store(shelf.name())?.get(JsValue::from_str(name))?.await
    }

    /// All names on a shelf, in order.
    pub(super) async fn names(&self, shelf: Shelf) -> Result<Vec<String>, Error> {
        let transaction = self.0.transaction(&[shelf.name()], TransactionMode::ReadOnly)?;
        let keys = transaction.object_store(shelf.name())?.get_all_keys(None::<Query>, None)?.await?;
        Ok(keys.iter().filter_map(JsValue::as_string).collect())
    }

    /// Keeps `value` under a name, in the place of what is there.
    pub(super) async fn put(&self, shelf: Shelf, name: &str, value: &JsValue) -> Result<(), Error> {
        let transaction = self.0.transaction(&[shelf.name()], TransactionMode::ReadWrite)?;
        transaction.object_store(shelf.name())?.put(value, Some(&JsValue::from_str(name)))?.await?;
        transaction.await.map(|_| ())
    }

    /// Forgets what is kept under a name.
    pub(super) async fn delete(&self, shelf: Shelf, name: &str) -> Result<(), Error> {
        let transaction = self.0.transaction(&[shelf.name()], TransactionMode::ReadWrite)?;
        transaction.object_store(shelf.name())?.delete(JsValue::from_str(name))?.await?;
        transaction.await.map(|_| ())
    }
}
