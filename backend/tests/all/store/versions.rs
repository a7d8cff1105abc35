//! Databases of older and newer versions of the program.

use std::sync::Arc;

use goalgraph_server::store::{NewToken, PageRequest, StoreError};
use sqlx::migrate::Migrator;

use super::place::{Place, on_every_database, revision};

static MIGRATIONS: Migrator = sqlx::migrate!();

on_every_database! {
    a_database_of_an_older_version_is_brought_up_to_date_with_all_it_holds,
    opening_a_database_again_changes_nothing,
    a_database_of_a_newer_version_is_refused,
    a_migration_that_was_not_this_programs_is_refused,
    of_many_who_open_a_new_database_at_once_one_makes_it,
}

async fn a_database_of_an_older_version_is_brought_up_to_date_with_all_it_holds(place: Arc<Place>) {
    std::fs::create_dir(place.data()).unwrap();
    let mut connection = place.connect().await;
    MIGRATIONS.run_to(1, &mut connection).await.unwrap();
    drop(connection);
    place
        .damage(
            "INSERT INTO specifications VALUES ('a', 1, 0, 1, 5, 0); \
             INSERT INTO revisions VALUES ('a', 1, 'old', \
             '44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a', '{}', NULL, 'Ada', '', 5); \
             UPDATE counters SET value = 1",
        )
        .await;
    let store = place.open().await;
    assert_eq!(store.content("a", 1).await.unwrap(), "{}");
    let newer = store.create(revision("1")).await.unwrap();
    let rows = store.specifications(&PageRequest::default()).await.unwrap().rows;
    assert_eq!(rows.iter().map(|row| row.id.as_str()).collect::<Vec<_>>(), [newer.id.as_str(), "a"]);
    let token = NewToken {
        id: "t".to_owned(),
        name: String::new(),
        role: "viewer".to_owned(),
        hash: String::new(),
        created_at_ms: 1,
    };
    store.create_token(token).await.unwrap();
    assert_eq!(store.verify().await.unwrap().faults, Vec::<String>::new());
}

async fn opening_a_database_again_changes_nothing(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    store.close().await;
    for _ in 0..3 {
        let store = place.open().await;
        assert_eq!(store.content(&id, 1).await.unwrap(), "1");
        store.close().await;
    }
}

async fn a_database_of_a_newer_version_is_refused(place: Arc<Place>) {
    place.open().await.close().await;
    place
        .damage(
            "INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time) \
             VALUES (99, 'of the future', TRUE, '', 0)",
        )
        .await;
    let error = place.try_open().await.unwrap_err();
    assert!(matches!(error, StoreError::NewerDatabase { found: 99, .. }), "{error}");
    let known = MIGRATIONS.iter().map(|it| it.version).max().unwrap();
    let message = format!(
        "the database is of a newer Goalgraph: it has migration 99, this program knows up to {known}; \
         use the newer program"
    );
    assert_eq!(error.to_string(), message);
}

async fn a_migration_that_was_not_this_programs_is_refused(place: Arc<Place>) {
    place.open().await.close().await;
    place.damage("UPDATE _sqlx_migrations SET checksum = '' WHERE version = 1").await;
    let error = place.try_open().await.unwrap_err();
    assert!(matches!(error, StoreError::Corrupt(_)), "{error}");
}

async fn of_many_who_open_a_new_database_at_once_one_makes_it(place: Arc<Place>) {
    let opening = [(); 6].map(|()| {
        let place = place.clone();
        tokio::spawn(async move { place.open().await })
    });
    let mut stores = Vec::new();
    for store in opening {
        stores.push(store.await.unwrap());
    }
    let id = stores[0].create(revision("1")).await.unwrap().id;
    assert_eq!(stores[5].content(&id, 1).await.unwrap(), "1");
}
