//! Copies of everything.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use goalgraph_server::store::{Location, NewEvent, NewRevision, NewToken, PageRequest, Store, StoreOptions};

use super::demonstrations::put;
use super::place::{Place, approve, on_every_database, revision, run_of, signature};

on_every_database! {
    a_backup_is_a_data_folder_with_everything_in_it,
    a_backup_while_others_write_is_of_one_moment,
    a_backup_replaces_nothing,
    a_backup_that_fails_leaves_nothing,
}

/// Something in every table, with and without what may be missing.
async fn fill(store: &Store) -> String {
    let with_positions = NewRevision { positions: Some("{}".to_owned()), ..revision("ä") };
    let specification = store.create(with_positions).await.unwrap();
    store.save(&specification.id, 1, revision("2")).await.unwrap();
    approve(store, &specification.id, 1, None, signature("Ada", 7)).await.unwrap();
    store.begin_run(run_of(&specification, "r")).await.unwrap();
    let event = NewEvent { number: 1, event: "{}".to_owned(), robot_at_ms: None, received_at_ms: -1 };
    store.append_event("r", event).await.unwrap();
    let file = put(store, "demo.csv", &["x\n1\n"]).await.unwrap();
    store.link_demonstration(&specification.id, &file.sha256, "demo_00.csv").await.unwrap();
    let token = NewToken {
        id: "t".to_owned(),
        name: "lab".to_owned(),
        role: "viewer".to_owned(),
        hash: "h".to_owned(),
        created_at_ms: 1,
    };
    store.create_token(token).await.unwrap();
    store.create_session("s", "t", 99).await.unwrap();
    let deleted = store.create(revision("deleted")).await.unwrap();
    store.delete(&deleted.id, 1).await.unwrap();
    specification.id
}

fn names_in(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

async fn open_copy(folder: PathBuf) -> Store {
    let options = StoreOptions { create: false, ..StoreOptions::default() };
    Store::open(&Location::folder(folder), options).await.unwrap()
}

async fn a_backup_is_a_data_folder_with_everything_in_it(place: Arc<Place>) {
    let store = place.open().await;
    let id = fill(&store).await;
    let folder = place.folder.path().join("copy");
    let report = store.backup(&folder).await.unwrap();
    assert_eq!((report.demonstrations, report.rows), (1, 13));
    assert_eq!(names_in(&folder), ["demonstrations", "goalgraph.lock", "goalgraph.sqlite"]);

    let copy = open_copy(folder).await;
    assert_eq!(copy.verify().await.unwrap(), store.verify().await.unwrap());
    assert_eq!(copy.specification(&id).await.unwrap(), store.specification(&id).await.unwrap());
    let all = PageRequest::default();
    assert_eq!(copy.revisions(&id, &all).await.unwrap(), store.revisions(&id, &all).await.unwrap());
    assert_eq!(copy.approvals(&id, &all).await.unwrap(), store.approvals(&id, &all).await.unwrap());
    assert_eq!(copy.latest_approved().await.unwrap(), store.latest_approved().await.unwrap());
    assert_eq!(copy.run("r").await.unwrap(), store.run("r").await.unwrap());
    assert_eq!(copy.events("r", 0, 9).await.unwrap(), store.events("r", 0, 9).await.unwrap());
    assert_eq!(copy.demonstrations_of(&id).await.unwrap(), store.demonstrations_of(&id).await.unwrap());
    assert_eq!(copy.tokens().await.unwrap(), store.tokens().await.unwrap());
    assert_eq!(copy.session("s").await.unwrap(), store.session("s").await.unwrap());
    // It goes on with the numbers where the original was.
    let (here, there) =
        (store.create(revision("3")).await.unwrap(), copy.create(revision("3")).await.unwrap());
    assert_eq!(here.saved_sequence, there.saved_sequence);
}

async fn a_backup_while_others_write_is_of_one_moment(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("0")).await.unwrap();
    store.begin_run(run_of(&specification, "r")).await.unwrap();
    let is_over = Arc::new(AtomicBool::new(false));
    let writer = {
        let (store, is_over, id) = (store.clone(), is_over.clone(), specification.id.clone());
        tokio::spawn(async move {
            let mut number = 0;
            while !is_over.load(Ordering::Relaxed) {
                number += 1;
                store.save(&id, number, revision(&number.to_string())).await.unwrap();
                let expected = if number == 1 { None } else { Some(number - 1) };
                approve(&store, &id, number, expected, signature("Ada", 1)).await.unwrap();
                let event = NewEvent { number, event: "{}".to_owned(), robot_at_ms: None, received_at_ms: 1 };
                store.append_event("r", event).await.unwrap();
                put(&store, "demo.csv", &[&number.to_string()]).await.unwrap();
            }
            number
        })
    };
    let mut heads = Vec::new();
    for number in 0..3 {
        let folder = place.folder.path().join(format!("copy {number}"));
        store.backup(&folder).await.unwrap();
        let copy = open_copy(folder).await;
        let report = copy.verify().await.unwrap();
        assert_eq!(report.faults, Vec::<String>::new());
        let head = copy.specification(&specification.id).await.unwrap().head;
        assert!((head.saturating_sub(2)..=head).contains(&report.events), "{head} {report:?}");
        heads.push(head);
    }
    is_over.store(true, Ordering::Relaxed);
    let written = writer.await.unwrap();
    assert!(heads.is_sorted() && heads[2] <= written + 1, "{heads:?} {written}");
}

async fn a_backup_replaces_nothing(place: Arc<Place>) {
    let store = place.open().await;
    fill(&store).await;
    let path = |name: &str| place.folder.path().join(name);
    fs::create_dir(path("full")).unwrap();
    fs::write(path("full").join("mine"), "").unwrap();
    fs::write(path("file"), "").unwrap();
    for name in ["full", "file"] {
        let error = store.backup(&path(name)).await.unwrap_err();
        assert_eq!(error.to_string(), format!("{}: it is there already", path(name).display()));
    }
    assert_eq!(names_in(&path("full")), ["mine"]);
    fs::create_dir(path("other.partial")).unwrap();
    let error = store.backup(&path("other")).await.unwrap_err().to_string();
    assert!(error.starts_with(&path("other.partial").display().to_string()), "{error}");
    fs::create_dir(path("empty")).unwrap();
    store.backup(&path("empty")).await.unwrap();
    assert!(store.backup(&path("nowhere").join("copy")).await.is_err());
    assert!(store.backup(Path::new("..")).await.is_err());
}

async fn a_backup_that_fails_leaves_nothing(place: Arc<Place>) {
    let store = place.open().await;
    let file = put(&store, "demo.csv", &["x"]).await.unwrap().sha256;
    fs::remove_file(place.data().join("demonstrations").join(&file[..2]).join(&file)).unwrap();
    let error = store.backup(&place.folder.path().join("copy")).await.unwrap_err();
    assert_eq!(error.to_string(), format!("damaged: demonstration {file}: the file is gone"));
    assert_eq!(names_in(place.folder.path()), ["data"]);
}
