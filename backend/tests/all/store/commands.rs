//! `goalgraph backup`, `verify` and `token`, on the database of a server that runs.

use std::sync::Arc;

use goalgraph_server::store::Location;
use goalgraph_server::token::Token;

use super::place::{Place, on_every_database, revision};
use crate::support::{Bench, Ended};

on_every_database! {
    backup_and_verify_work_beside_a_server,
    a_token_is_shown_once_and_its_hash_kept,
}

fn run(place: &Place, words: &[&str]) -> Ended {
    let store = place.arguments();
    let arguments: Vec<&str> = words.iter().copied().chain(store.iter().map(String::as_str)).collect();
    Bench::new().run(&arguments)
}

async fn backup_and_verify_work_beside_a_server(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("{}")).await.unwrap().id;
    let folder = place.folder.path().join("copy");
    let name = folder.to_str().unwrap();
    let ended = run(&place, &["backup", "-o", name]);
    assert_eq!((ended.status, ended.stdout.as_str()), (0, ""), "{ended:?}");
    assert_eq!(ended.stderr, format!("{name}: 3 rows and 0 demonstration files\n"));
    let ended = run(&place, &["backup", "-o", name]);
    assert_eq!((ended.status, ended.stderr), (1, format!("{name}: it is there already\n")));

    let checked = "checked 1 revision, 0 approvals, 0 runs, 0 run events and 0 demonstration files\n";
    let bench = Bench::new();
    assert_eq!(bench.succeed(&["verify", "--data", name]), checked);
    assert_eq!(run(&place, &["verify"]).stdout, checked);
    place.damage("UPDATE revisions SET sha256 = 'abc'").await;
    let ended = run(&place, &["verify"]);
    assert_eq!((ended.status, ended.stdout.as_str()), (1, checked));
    let fault = format!("specification {id}, revision 1: the content has the SHA-256 44136fa3");
    assert!(ended.stderr.starts_with(&fault) && ended.stderr.lines().count() == 1, "{ended:?}");
}

async fn a_token_is_shown_once_and_its_hash_kept(place: Arc<Place>) {
    let created = run(&place, &["token", "create", "lab\tdoor", "--role", "approver"]);
    assert_eq!(created.status, 0, "{created:?}");
    let token = Token::parse(created.stdout.trim_end()).unwrap();
    let row = place.open().await.token(token.id()).await.unwrap();
    assert_eq!((row.name.as_str(), row.role.as_str()), ("lab\tdoor", "approver"));
    assert!(token.verify(&row.hash));

    let listed = run(&place, &["token", "list"]).stdout;
    assert!(listed.starts_with(&format!("{}  approver  20", token.id())), "{listed}");
    assert!(listed.ends_with("  lab door\n") && listed.lines().count() == 1, "{listed}");
    assert_eq!(run(&place, &["token", "revoke", token.id()]).status, 0);
    assert!(run(&place, &["token", "list"]).stdout.contains("  lab door  (revoked 20"));
    let again = run(&place, &["token", "revoke", "nobody"]);
    assert_eq!(again.status, 1);
    assert_eq!(again.stderr, format!("{}: there is no token nobody\n", place.location()));
    assert_eq!(run(&place, &["token", "create", "x", "--role", "root"]).status, 2);
}

#[test]
fn without_a_database_there_is_nothing_to_copy_check_or_revoke() {
    let bench = Bench::new();
    let folder = bench.path("none");
    let (folder, copy) = (folder.to_str().unwrap(), bench.path("copy"));
    let line = format!("{folder}: there is no Goalgraph database in this folder");
    for command in [
        vec!["backup", "-o", copy.to_str().unwrap()],
        vec!["verify"],
        vec!["token", "list"],
        vec!["token", "revoke", "x"],
    ] {
        let arguments = [command, vec!["--data", folder]].concat();
        bench.fail(&arguments, 1, &[&line]);
    }
    assert_eq!(bench.files(), Vec::<String>::new());
}

#[test]
fn a_password_in_the_address_of_a_database_is_not_repeated() {
    let bench = Bench::new();
    let url = "postgres://me:hunter2@127.0.0.1:1/robots";
    let ended = bench.run(&["verify", "--data", bench.path(".").to_str().unwrap(), "--database", url]);
    assert_eq!(ended.status, 1);
    let location = Location { data: bench.path("."), database: Some(url.to_owned()) };
    assert!(ended.stderr.starts_with(&format!("{location}: the database failed: ")), "{ended:?}");
    assert!(!format!("{ended:?}").contains("hunter2"), "{ended:?}");
}
