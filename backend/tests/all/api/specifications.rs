//! Saving, reading, listing, deleting.

use goalgraph::protocol::api::{Page, Problem, Revision, RevisionContent, SpecificationEntry};
use serde_json::json;

use super::{create, save, saved, specification};
use crate::http::Server;

#[test]
fn what_is_saved_is_read_back_byte_for_byte() {
    let server = Server::start();
    let content = specification("Two stacks", &["a b", "b a"]);
    let (entry, etag) = create(&server, &content);
    assert_eq!((entry.name.as_str(), entry.head.number, entry.approved), ("Two stacks", 1, None));
    let path = format!("/api/v1/specifications/{}", entry.id);
    let again = server.get(&path).expect(200);
    assert_eq!(saved(&again), (entry.clone(), etag.clone()));

    let revision = server.get(&format!("{path}/revisions/1")).expect(200);
    assert_eq!(revision.header("etag"), etag);
    let revision: RevisionContent = revision.json();
    assert_eq!((revision.content.as_str(), revision.revision), (content.as_str(), entry.head));
    let file = server.get(&format!("{path}/revisions/1/specification")).expect(200);
    assert_eq!((file.text(), file.header("content-type")), (content, "application/json"));
}

#[test]
fn content_is_kept_in_its_canonical_form() {
    let server = Server::start();
    let content = specification("Blocks", &["a b"]);
    let loose: serde_json::Value = serde_json::from_str(&content).unwrap();
    let (entry, _) = create(&server, &serde_json::to_string_pretty(&loose).unwrap());
    let (tight, _) = create(&server, &content);
    assert_eq!(entry.head.sha256, tight.head.sha256);
}

#[test]
fn a_save_on_top_of_something_older_is_refused_and_tells_who_saved_what() {
    let server = Server::start();
    let (entry, first) = create(&server, &specification("Blocks", &["a b"]));
    let path = format!("/api/v1/specifications/{}", entry.id);
    let later = specification("Blocks", &["a b", "b a"]);
    let answer = server.send_json("PUT", &path, &[("if-match", &first)], &save(&later, "Bob")).expect(200);
    let (bobs, second) = saved(&answer);
    assert_eq!((bobs.head.number, bobs.head.author.as_str()), (2, "Bob"));
    assert_ne!(first, second);

    let refused = server.send_json("PUT", &path, &[("if-match", &first)], &save(&later, "Eve")).expect(412);
    let problem: Problem = refused.json();
    assert_eq!(problem.head.as_ref(), Some(&bobs.head));
    assert!(problem.detail.starts_with("Bob saved revision 2 at 20"), "{}", problem.detail);
    let refused = server.send_json("PUT", &path, &[], &save(&later, "Eve"));
    assert!(refused.detail(428).starts_with("send the ETag of the revision that you know in If-Match"));

    let any = server.send_json("PUT", &path, &[("if-match", "\"x\", *")], &save(&later, "Eve")).expect(200);
    assert_eq!(saved(&any).0.head.number, 3);
    let revisions: Page<Revision> = server.get(&format!("{path}/revisions")).json();
    let authors: Vec<_> = revisions.items.iter().map(|it| (it.number, it.author.as_str())).collect();
    assert_eq!(authors, [(3, "Eve"), (2, "Bob"), (1, "Ada")]);
}

#[test]
fn of_many_who_save_at_once_on_the_same_revision_one_wins() {
    let server = Server::start();
    let (entry, etag) = create(&server, &specification("Blocks", &["a b"]));
    let path = format!("/api/v1/specifications/{}", entry.id);
    let content = specification("Blocks", &["a b", "b a"]);
    let statuses: Vec<u16> = std::thread::scope(|scope| {
        let saver = |author: usize| {
            let (server, path, etag, content) = (&server, &path, &etag, &content);
            scope.spawn(move || {
                let body = save(content, &author.to_string());
                server.send_json("PUT", path, &[("if-match", etag)], &body).status
            })
        };
        (0..16).map(saver).collect::<Vec<_>>().into_iter().map(|it| it.join().unwrap()).collect()
    });
    assert_eq!(statuses.iter().filter(|&&status| status == 200).count(), 1, "{statuses:?}");
    assert!(statuses.iter().all(|&status| matches!(status, 200 | 412)), "{statuses:?}");
    assert_eq!(saved(&server.get(&path)).0.head.number, 2);
}

#[test]
fn lists_come_in_parts_the_one_saved_last_first() {
    let server = Server::start();
    let ids: Vec<String> =
        (0..7).map(|n| create(&server, &specification(&format!("task {n}"), &["a"])).0.id).collect();
    let mut found = Vec::new();
    let mut path = "/api/v1/specifications?limit=3".to_owned();
    loop {
        let page: Page<SpecificationEntry> = server.get(&path).expect(200).json();
        assert!(page.items.len() <= 3);
        found.extend(page.items.into_iter().map(|it| it.id));
        match page.next {
            Some(next) => path = format!("/api/v1/specifications?limit=3&after={next}"),
            None => break,
        }
    }
    found.reverse();
    assert_eq!(found, ids);
    assert!(server.get("/api/v1/specifications?after=nowhere").detail(422).contains("nowhere"));
    assert!(server.get("/api/v1/specifications?limit=many").detail(400).contains("limit"));
}

#[test]
fn what_is_deleted_is_not_found_any_more() {
    let server = Server::start();
    let (entry, etag) = create(&server, &specification("Blocks", &["a b"]));
    let path = format!("/api/v1/specifications/{}", entry.id);
    assert_eq!(server.request("DELETE", &path, &[]).status, 428);
    assert_eq!(server.request("DELETE", &path, &[("if-match", "\"other\"")]).status, 412);
    server.request("DELETE", &path, &[("if-match", &etag)]).expect(204);
    assert_eq!(server.get(&path).detail(404), format!("there is no specification {}", entry.id));
    let page: Page<SpecificationEntry> = server.get("/api/v1/specifications").json();
    assert_eq!(page.items, []);
}

#[test]
fn content_that_is_no_specification_is_refused_with_its_place() {
    let server = Server::start();
    let refused =
        |body: &serde_json::Value| server.send_json("POST", "/api/v1/specifications", &[], body).detail(422);
    assert!(
        refused(&save("{", "Ada")).starts_with("content: line 1, column "),
        "{}",
        refused(&save("{", "Ada"))
    );
    let contradicting =
        specification("Blocks", &["a b"]).replace("\"probability\": 1", "\"probability\": 0.5");
    assert!(refused(&save(&contradicting, "Ada")).contains("probability"));
    assert!(refused(&json!({"author": "Ada"})).contains("content"));
    let long = json!({"content": specification("Blocks", &["a"]), "author": "A".repeat(201)});
    assert_eq!(refused(&long), "author: 201 characters; at most 200 are taken");
    let control = json!({"content": specification("Blocks", &["a"]), "message": "a\u{0}b"});
    assert_eq!(refused(&control), "message: holds the control character '\\0'");
    let places = json!({"content": specification("Blocks", &["a"]), "positions": "here"});
    assert_eq!(refused(&places), "positions: expected an object, or null");
    let unknown = json!({"content": "", "writer": "Ada"});
    assert!(refused(&unknown).contains("unknown field `writer`"));
}

#[test]
fn names_and_messages_may_hold_whatever_people_write() {
    let server = Server::start();
    for name in
        ["'; DROP TABLE revisions; --", "<script>alert(1)</script>", "木のブロック 🧱", "\" \\ %s {} $1"]
    {
        let (entry, _) = create(&server, &specification(name, &["a"]));
        let found: SpecificationEntry = server.get(&format!("/api/v1/specifications/{}", entry.id)).json();
        assert_eq!((found.name.as_str(), found.head.name.as_str()), (name, name));
    }
}
