//! Demonstration files.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use futures_util::stream;
use goalgraph_server::store::{DemonstrationRow, NewDemonstration, Store, StoreError};
use tokio::io::AsyncReadExt;

use super::place::{Place, on_every_database, revision};

on_every_database! {
    a_file_is_kept_once_whatever_it_is_called,
    a_file_that_is_too_large_or_breaks_off_leaves_nothing,
    files_are_linked_to_the_specifications_that_use_them,
    damaged_and_missing_files_are_found,
    a_damaged_file_is_whole_again_when_it_comes_again,
    what_is_left_of_an_interrupted_upload_can_be_removed,
}

fn named(name: &str) -> NewDemonstration {
    NewDemonstration {
        name: name.to_owned(),
        media_type: "text/csv".to_owned(),
        limit_bytes: 10,
        expected_sha256: None,
        at_ms: 1,
    }
}

/// Puts a file that comes in pieces.
pub(crate) async fn put(store: &Store, name: &str, pieces: &[&str]) -> Result<DemonstrationRow, StoreError> {
    let pieces: Vec<io::Result<Vec<u8>>> = pieces.iter().map(|it| Ok(it.as_bytes().to_vec())).collect();
    store.put_demonstration(named(name), stream::iter(pieces)).await
}

/// Every file below a folder.
fn files_in(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files_in(&path) } else { vec![path] }).collect()
}

/// Every demonstration file in a data folder.
fn demonstration_files(data: &Path) -> Vec<PathBuf> {
    files_in(&data.join("demonstrations"))
}

async fn a_file_is_kept_once_whatever_it_is_called(place: Arc<Place>) {
    let store = place.open().await;
    let first = put(&store, "../../a'b.csv", &["x\n", "1", "\n"]).await.unwrap();
    // printf 'x\n1\n' | sha256sum
    let sha256 = "daff832f802000e645771a60983c76c963f6ee602a6230e45237bd360e91cc1a";
    assert_eq!((first.bytes, first.name.as_str()), (4, "../../a'b.csv"));
    assert_eq!(first.sha256, sha256);
    assert_eq!(put(&store, "again.csv", &["x\n1\n"]).await.unwrap(), first);
    let path = place.data().join("demonstrations").join(&first.sha256[..2]).join(&first.sha256);
    assert_eq!(demonstration_files(&place.data()), [path]);

    let (row, mut file) = store.open_demonstration(&first.sha256).await.unwrap();
    let mut content = String::new();
    file.read_to_string(&mut content).await.unwrap();
    assert_eq!((row, content.as_str()), (first, "x\n1\n"));
    let empty = put(&store, "empty.csv", &[]).await.unwrap();
    assert_eq!(empty.sha256, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    assert_eq!(empty.bytes, 0);
    let (one, two) = tokio::join!(put(&store, "1", &["same"]), put(&store, "2", &["sa", "me"]));
    assert_eq!(one.unwrap(), two.unwrap());
    assert_eq!(store.verify().await.unwrap().demonstrations, 3);
}

async fn a_file_that_is_too_large_or_breaks_off_leaves_nothing(place: Arc<Place>) {
    let store = place.open().await;
    put(&store, "just.csv", &["0123456789"]).await.unwrap();
    let error = put(&store, "a.csv", &["01234", "56789", "x"]).await.unwrap_err();
    assert_eq!(error.to_string(), "the file is larger than 10 bytes");
    let broken = [Ok("abc"), Err(io::Error::other("the connection broke"))];
    let error = store.put_demonstration(named("b.csv"), stream::iter(broken)).await.unwrap_err();
    assert!(error.to_string().ends_with("the connection broke"), "{error}");
    let error = put(&store, "a\0.csv", &["a"]).await.unwrap_err();
    assert_eq!(error.to_string(), "the file's name holds a NUL character");
    assert_eq!(demonstration_files(&place.data()).len(), 1);
    assert_eq!(store.verify().await.unwrap().demonstrations, 1);
}

async fn files_are_linked_to_the_specifications_that_use_them(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    let (one, two) =
        (put(&store, "1.csv", &["1"]).await.unwrap(), put(&store, "2.csv", &["2"]).await.unwrap());
    store.link_demonstration(&id, &two.sha256, "demo_00.csv").await.unwrap();
    store.link_demonstration(&id, &one.sha256, "demo_01.csv").await.unwrap();
    store.link_demonstration(&id, &two.sha256, "renamed.csv").await.unwrap();
    let linked = store.demonstrations_of(&id).await.unwrap();
    let seen: Vec<_> = linked.iter().map(|it| (it.name.as_str(), it.sha256.as_str(), it.bytes)).collect();
    assert_eq!(seen, [("renamed.csv", two.sha256.as_str(), 1), ("demo_01.csv", one.sha256.as_str(), 1)]);
    let missing = store.link_demonstration(&id, "abc", "x").await.unwrap_err();
    assert_eq!(missing.to_string(), "there is no demonstration abc");
    let nowhere = store.link_demonstration("x", &one.sha256, "x").await.unwrap_err();
    assert_eq!(nowhere.to_string(), "there is no specification x");
    for sha256 in ["", "a", "../../goalgraph.sqlite", "ö"] {
        let error = store.open_demonstration(sha256).await.unwrap_err();
        assert!(matches!(error, StoreError::NotFound { .. }), "{error}");
    }
}

async fn damaged_and_missing_files_are_found(place: Arc<Place>) {
    let store = place.open().await;
    let intact = put(&store, "0.csv", &["intact"]).await.unwrap();
    let (changed, cut) =
        (put(&store, "1.csv", &["abc"]).await.unwrap(), put(&store, "2.csv", &["cut"]).await.unwrap());
    let gone = put(&store, "3.csv", &["gone"]).await.unwrap();
    let path =
        |row: &DemonstrationRow| place.data().join("demonstrations").join(&row.sha256[..2]).join(&row.sha256);
    fs::write(path(&changed), "abd").unwrap();
    fs::write(path(&cut), "cu").unwrap();
    fs::remove_file(path(&gone)).unwrap();

    let report = store.verify().await.unwrap();
    assert_eq!(report.demonstrations, 4);
    let about = |row: &DemonstrationRow, what: &str| {
        let start = format!("demonstration {}: {what}", row.sha256);
        report.faults.iter().filter(|fault| fault.starts_with(&start)).count()
    };
    let found = [about(&changed, "the file has the SHA-256 "), about(&cut, "the file has the SHA-256 ")];
    assert_eq!(found, [1, 1], "{:?}", report.faults);
    assert_eq!(about(&gone, "the file cannot be read"), 1);
    assert_eq!(report.faults.len(), 3);

    store.open_demonstration(&intact.sha256).await.unwrap();
    let error = store.open_demonstration(&cut.sha256).await.unwrap_err();
    let expected = format!("damaged: demonstration {}: 2 bytes, stored were 3", cut.sha256);
    assert_eq!(error.to_string(), expected);
    let error = store.open_demonstration(&gone.sha256).await.unwrap_err();
    assert_eq!(error.to_string(), format!("damaged: demonstration {}: the file is gone", gone.sha256));
}

async fn a_damaged_file_is_whole_again_when_it_comes_again(place: Arc<Place>) {
    let store = place.open().await;
    let row = put(&store, "1.csv", &["abc"]).await.unwrap();
    fs::write(&demonstration_files(&place.data())[0], "abd").unwrap();
    assert_eq!(store.verify().await.unwrap().faults.len(), 1);
    assert_eq!(put(&store, "2.csv", &["abc"]).await.unwrap(), row);
    assert_eq!(store.verify().await.unwrap().faults, Vec::<String>::new());
}

async fn what_is_left_of_an_interrupted_upload_can_be_removed(place: Arc<Place>) {
    let store = place.open().await;
    assert_eq!(store.remove_abandoned_uploads().await.unwrap(), 0);
    put(&store, "1.csv", &["abc"]).await.unwrap();
    fs::write(place.data().join("demonstrations").join("incoming").join("x"), "half").unwrap();
    assert_eq!(store.remove_abandoned_uploads().await.unwrap(), 1);
    assert_eq!(demonstration_files(&place.data()).len(), 1);
    assert_eq!(store.verify().await.unwrap().faults, Vec::<String>::new());
}
