//! Full disks, locked databases, damaged files and wrong addresses.

use std::fs;
use std::sync::Arc;
use std::time::Duration;

use goalgraph_server::store::{
    Appended, Backend, Location, NewEvent, PageRequest, Store, StoreError, StoreOptions,
};
use sqlx::Executor;

use super::place::{Place, on_every_database, revision, run, run_of};

on_every_database! {
    a_database_that_another_program_has_locked_is_waited_for_and_then_said,
    a_store_works_again_after_a_write_was_given_up_half_way,
    another_store_on_the_same_database_sees_and_respects_what_is_saved,
    a_store_is_used_by_many_tasks_at_once,
}

async fn a_database_that_another_program_has_locked_is_waited_for_and_then_said(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    let mut other = place.connect().await;
    let lock = match place.backend {
        Backend::Sqlite => "BEGIN IMMEDIATE",
        Backend::Postgres => "BEGIN; LOCK TABLE specifications, counters IN EXCLUSIVE MODE",
    };
    other.execute(lock).await.unwrap();
    let savers = [(); 4].map(|()| {
        let (store, id) = (store.clone(), id.clone());
        tokio::spawn(async move { store.save(&id, 1, revision("2")).await })
    });
    for saver in savers {
        let error = saver.await.unwrap().unwrap_err();
        assert!(matches!(error, StoreError::Busy), "{error}");
    }
    // Reading goes on.
    assert_eq!(store.content(&id, 1).await.unwrap(), "1");
    other.execute("ROLLBACK").await.unwrap();
    assert_eq!(store.save(&id, 1, revision("2")).await.unwrap().number, 2);
}

async fn a_store_works_again_after_a_write_was_given_up_half_way(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    for round in 0..40 {
        // A client that goes away ends its request wherever that is.
        let saving = store.save(&id, round, revision("never awaited to the end"));
        let _ = tokio::time::timeout(Duration::from_micros(50 * round), saving).await;
    }
    let head = store.specification(&id).await.unwrap().head;
    let patient = StoreOptions::default();
    let store = Store::open(&place.location(), patient).await.unwrap();
    assert_eq!(store.save(&id, head, revision("last")).await.unwrap().number, head + 1);
    assert_eq!(store.verify().await.unwrap().faults, Vec::<String>::new());
}

async fn another_store_on_the_same_database_sees_and_respects_what_is_saved(place: Arc<Place>) {
    let (one, two) = tokio::join!(place.open(), place.open());
    let id = one.create(revision("1")).await.unwrap().id;
    two.save(&id, 1, revision("2")).await.unwrap();
    let error = one.save(&id, 1, revision("3")).await.unwrap_err();
    assert!(matches!(error, StoreError::Conflict(_)), "{error}");
    one.save(&id, 2, revision("3")).await.unwrap();
    assert_eq!(two.content(&id, 3).await.unwrap(), "3");
}

async fn a_store_is_used_by_many_tasks_at_once(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("1")).await.unwrap();
    let mut tasks = tokio::task::JoinSet::new();
    for number in 0..20 {
        let (store, specification) = (store.clone(), specification.clone());
        let copy = place.folder.path().join(format!("copy {number}"));
        tasks.spawn(async move {
            let id = format!("run {number}");
            store.begin_run(run_of(&specification, &id)).await.unwrap();
            let event = NewEvent { number: 1, event: "{}".to_owned(), robot_at_ms: None, received_at_ms: 1 };
            assert_eq!(store.append_events(&id, &[event]).await.unwrap(), [Appended::Stored]);
            store.revisions(&specification.id, &PageRequest::default()).await.unwrap();
            assert_eq!(store.verify().await.unwrap().faults, Vec::<String>::new());
            if number % 10 == 0 {
                store.backup(&copy).await.unwrap();
            }
        });
    }
    while let Some(ended) = tasks.join_next().await {
        ended.unwrap();
    }
    assert_eq!(store.verify().await.unwrap().events, 20);
}

#[test]
fn on_a_full_disk_nothing_is_half_stored_and_what_was_acknowledged_stays() {
    run(Backend::Sqlite, async |place: Arc<Place>| {
        let options = StoreOptions { max_pages: Some(120), ..StoreOptions::default() };
        let store = Store::open(&place.location(), options).await.unwrap();
        let specification = store.create(revision("1")).await.unwrap();
        store.begin_run(run_of(&specification, "r")).await.unwrap();
        let large = "x".repeat(20_000);
        let mut head = 1;
        let error = loop {
            match store.save(&specification.id, head, revision(&large)).await {
                Ok(row) => head = row.number,
                Err(error) => break error,
            }
        };
        assert!(matches!(error, StoreError::Full), "{error}");
        assert!(head > 3, "{head}");
        for _ in 0..20 {
            let error = store.save(&specification.id, head, revision(&large)).await.unwrap_err();
            assert!(matches!(error, StoreError::Full), "{error}");
        }
        let mut last = 0;
        let error = loop {
            let event = NewEvent {
                number: last + 1,
                event: large[..3_000].to_owned(),
                robot_at_ms: None,
                received_at_ms: 1,
            };
            match store.append_event("r", event).await {
                Ok(outcome) => assert_eq!(outcome, Appended::Stored),
                Err(error) => break error,
            }
            last += 1;
        };
        assert!(matches!(error, StoreError::Full), "{error}");
        assert_eq!(store.run("r").await.unwrap().last_event, last);
        store.close().await;

        let store = place.open().await;
        assert_eq!(store.specification(&specification.id).await.unwrap().head, head);
        assert_eq!(store.content(&specification.id, head).await.unwrap(), large);
        let report = store.verify().await.unwrap();
        assert_eq!((report.revisions, report.events, report.faults), (head, last, vec![]));
        // With space it goes on where it was.
        store.save(&specification.id, head, revision(&large)).await.unwrap();
    });
}

#[test]
fn bytes_that_changed_in_the_database_file_are_found() {
    run(Backend::Sqlite, async |place: Arc<Place>| {
        let store = place.open().await;
        let id = store.create(revision("{\"marker\":\"a-rare-text\"}")).await.unwrap().id;
        store.close().await;
        let file = place.data().join("goalgraph.sqlite");
        let mut bytes = fs::read(&file).unwrap();
        let at = bytes.windows(6).position(|window| window == b"{\"mark").unwrap();
        for (changed, is_text) in [(b'M', true), (0xff, false)] {
            bytes[at + 2] = changed;
            fs::write(&file, &bytes).unwrap();
            let store = place.open().await;
            let error = store.content(&id, 1).await.unwrap_err();
            assert!(matches!(error, StoreError::Corrupt(_)), "{error}");
            let faults = store.verify().await.unwrap().faults;
            assert_eq!(faults.len(), 1, "{faults:?}");
            let start = if is_text {
                format!("specification {id}, revision 1: ")
            } else {
                "the revisions: ".to_owned()
            };
            assert!(faults[0].starts_with(&start), "{faults:?}");
            store.close().await;
        }
    });
}

#[test]
fn a_file_that_is_no_database_is_said() {
    run(Backend::Sqlite, async |place: Arc<Place>| {
        fs::create_dir(place.data()).unwrap();
        fs::write(
            place.data().join("goalgraph.sqlite"),
            "no database, but long enough to be looked at".repeat(99),
        )
        .unwrap();
        let error = place.try_open().await.unwrap_err();
        assert_eq!(error.to_string(), "damaged: the database file: file is not a database");
    });
}

#[test]
fn a_data_folder_may_have_any_name() {
    run(Backend::Sqlite, async |place: Arc<Place>| {
        for name in ["a b", "100%", "%41", "who?", "#1", "é 机器", "..x", "a'b\"c"] {
            let location = Location::folder(place.folder.path().join(name));
            let store = Store::open(&location, StoreOptions::default()).await.unwrap();
            store.create(revision("1")).await.unwrap();
            store.close().await;
            assert!(location.data.join("goalgraph.sqlite").is_file(), "{name}");
        }
    });
}

#[test]
fn where_nothing_may_be_made_nothing_is() {
    run(Backend::Sqlite, async |place: Arc<Place>| {
        let options = StoreOptions { create: false, ..StoreOptions::default() };
        let error = Store::open(&place.location(), options).await.unwrap_err();
        let message = format!("{}: there is no Goalgraph database in this folder", place.data().display());
        assert_eq!(error.to_string(), message);
        assert!(!place.data().exists());
        fs::create_dir(place.data()).unwrap();
        assert_eq!(Store::open(&place.location(), options).await.unwrap_err().to_string(), message);
        assert_eq!(fs::read_dir(place.data()).unwrap().count(), 0);
        fs::write(place.folder.path().join("file"), "").unwrap();
        let error =
            Store::open(&Location::folder(place.folder.path().join("file")), StoreOptions::default()).await;
        assert!(matches!(error, Err(StoreError::Io { .. })));
    });
}

#[test]
fn an_address_of_no_database_is_refused_without_its_password() {
    run(Backend::Sqlite, async |place: Arc<Place>| {
        for url in [
            "mysql://me:hunter2@localhost/x",
            "hunter2",
            "postgres://me:hunter2@[/",
            "postgres://me:hunter2@127.0.0.1:1/x",
            "postgres://me:hunter2@127.0.0.1:1/x?sslmode=hunter2",
            "postgres://127.0.0.1:1/x?password=hunter2",
        ] {
            let location = Location { data: place.data(), database: Some(url.to_owned()) };
            let error = Store::open(&location, StoreOptions::default()).await.unwrap_err();
            let shown = format!("{error} {error:?} {location} {location:?}");
            assert!(!shown.contains("hunter2"), "{shown}");
        }
    });
}

#[test]
fn the_database_is_in_wal_mode_and_the_folder_for_its_owner_alone() {
    run(Backend::Sqlite, async |place: Arc<Place>| {
        let store = place.open().await;
        store.ping().await.unwrap();
        assert_eq!(store.backend(), Backend::Sqlite);
        assert_eq!(store.specifications(&PageRequest::default()).await.unwrap().rows, []);
        let mut connection = place.connect().await;
        let mode: String =
            sqlx::query_scalar("PRAGMA journal_mode").fetch_one(&mut connection).await.unwrap();
        assert_eq!(mode, "wal");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            assert_eq!(fs::metadata(place.data()).unwrap().permissions().mode() & 0o777, 0o700);
        }
    });
}
