//! Approving and revoking.

use goalgraph::protocol::api::{Approval, Decision, Page, Problem, SpecificationEntry};
use serde_json::{Value, json};

use super::{create, save, specification};
use crate::http::{Answer, Server};

fn sign(
    server: &Server,
    path: &str,
    entry: &SpecificationEntry,
    who: &str,
    instead_of: Option<u64>,
) -> Answer {
    let body = json!({"who": who, "meaning": "for the robot", "sha256": entry.head.sha256, "instead_of": instead_of});
    server.send_json("POST", path, &[], &body)
}

fn of(entry: &SpecificationEntry, rest: &str) -> String {
    format!("/api/v1/specifications/{}{rest}", entry.id)
}

#[test]
fn one_revision_is_approved_at_a_time_and_the_journal_tells_all() {
    let server = Server::start();
    let (first, etag) = create(&server, &specification("Blocks", &["a b"]));
    let later = save(&specification("Blocks", &["a b", "b a"]), "Bob");
    let second: SpecificationEntry =
        server.send_json("PUT", &of(&first, ""), &[("if-match", &etag)], &later).expect(200).json();

    let approved: Approval =
        sign(&server, &of(&first, "/revisions/1/approval"), &first, "Ada", None).expect(201).json();
    assert_eq!((approved.revision, approved.decision), (1, Decision::Approved));
    sign(&server, &of(&first, "/revisions/2/approval"), &second, "Bob", Some(1)).expect(201);
    let entry: SpecificationEntry = server.get(&of(&first, "")).json();
    assert_eq!(entry.approved, Some(2));
    sign(&server, &of(&first, "/revisions/2/revocation"), &second, "Eve", Some(2)).expect(201);
    assert_eq!(server.get(&of(&first, "")).json::<SpecificationEntry>().approved, None);

    let journal: Page<Approval> = server.get(&of(&first, "/approvals")).json();
    let lines: Vec<_> = journal.items.iter().map(|it| (it.revision, it.decision, it.who.as_str())).collect();
    let expected =
        [(2, Decision::Revoked, "Eve"), (2, Decision::Approved, "Bob"), (1, Decision::Approved, "Ada")];
    assert_eq!(lines, expected);
    assert_eq!(server.get(&of(&first, "/approved")).status, 404);
}

#[test]
fn of_two_who_approve_at_once_one_is_told_of_the_other() {
    let server = Server::start();
    let (entry, _) = create(&server, &specification("Blocks", &["a b"]));
    let path = of(&entry, "/revisions/1/approval");
    let answers = std::thread::scope(|scope| {
        let signer = |who: &'static str| {
            let (server, path, entry) = (&server, &path, &entry);
            scope.spawn(move || sign(server, path, entry, who, None))
        };
        ["Ada", "Bob"].map(signer).map(|it| it.join().unwrap())
    });
    let mut statuses = answers.each_ref().map(|it| it.status);
    statuses.sort_unstable();
    assert_eq!(statuses, [201, 409]);
    let lost: Problem = answers.iter().find(|it| it.status == 409).unwrap().json();
    assert_eq!(lost.approved, Some(1));
    let won: Approval = answers.iter().find(|it| it.status == 201).unwrap().json();
    assert_eq!(lost.detail, format!("revision 1 was approved by {}", won.who));
}

#[test]
fn what_has_an_error_or_is_not_what_was_looked_at_is_not_approved() {
    let server = Server::start();
    let dead_end = specification("Blocks", &["a b"])
        .replace("\"accepting\": true", "\"accepting\": false")
        .replace("\"end_count\": 1", "\"end_count\": 0")
        .replace("\"end_weight\": 1", "\"end_weight\": 0")
        .replace("\"final_probability\": 1", "\"final_probability\": 0");
    let (faulty, _) = create(&server, &dead_end);
    let problem: Problem =
        sign(&server, &of(&faulty, "/revisions/1/approval"), &faulty, "Ada", None).expect(422).json();
    assert!(!problem.findings.is_empty() && problem.detail.contains(&problem.findings[0]), "{problem:?}");

    let (entry, _) = create(&server, &specification("Blocks", &["a b"]));
    let path = of(&entry, "/revisions/1/approval");
    let signature = |change: fn(&mut Value)| {
        let mut body =
            json!({"who": "Ada", "meaning": "ok", "sha256": entry.head.sha256, "instead_of": null});
        change(&mut body);
        server.send_json("POST", &path, &[], &body)
    };
    assert!(
        signature(|it| it["sha256"] = "0".repeat(64).into())
            .detail(409)
            .contains("not the one that was looked at")
    );
    assert_eq!(
        signature(|it| it["who"] = "  ".into()).detail(422),
        "a signature needs a name (who) and a meaning"
    );
    assert_eq!(
        signature(|it| it["meaning"] = "".into()).detail(422),
        "a signature needs a name (who) and a meaning"
    );
    assert_eq!(signature(|it| it["instead_of"] = 7.into()).detail(409), "no revision is approved");
    assert_eq!(sign(&server, &of(&entry, "/revisions/9/approval"), &entry, "Ada", None).status, 404);
    assert_eq!(sign(&server, &of(&entry, "/revisions/1/revocation"), &entry, "Ada", None).status, 409);
    assert_eq!(server.get(&of(&entry, "/approvals")).json::<Page<Approval>>().items, []);
}

#[test]
fn what_was_approved_at_a_time_is_told() {
    let server = Server::start();
    let (entry, etag) = create(&server, &specification("Blocks", &["a b"]));
    let before = "2001-01-01T00:00:00Z";
    let approved: Approval =
        sign(&server, &of(&entry, "/revisions/1/approval"), &entry, "Ada", None).expect(201).json();
    let at = |time: &str| server.get(&of(&entry, &format!("/approved?at={time}")));
    assert_eq!(at(&approved.at).expect(200).json::<Approval>(), approved);
    assert_eq!(at("2999-01-01T01:00:00%2B01:00").expect(200).json::<Approval>(), approved);
    assert_eq!(at(before).status, 404);
    assert_eq!(at("noon").detail(400), "at: \"noon\" is no time such as 2026-01-31T12:00:00Z");
    let refused = server.request("DELETE", &of(&entry, ""), &[("if-match", &etag)]);
    assert_eq!(refused.detail(409), "revision 1 is approved and may be with a robot; revoke it first");
}
