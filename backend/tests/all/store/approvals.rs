//! The journal of approvals.

use std::sync::Arc;

use goalgraph_server::store::{ApprovalKind, Conflict, NewApproval, PageRequest, Signature, StoreError};

use super::place::{Place, approve, on_every_database, revision, signature};

on_every_database! {
    one_revision_is_approved_at_a_time_and_the_journal_keeps_all,
    of_two_approvers_at_once_one_wins_and_the_other_learns_who,
    what_was_not_looked_at_is_not_approved,
    a_revoked_approval_leaves_none,
    what_was_approved_at_a_time_follows_the_journal_where_the_clock_went_back,
    the_latest_approval_of_the_server_is_the_last_that_holds,
    verify_finds_a_journal_that_does_not_fit,
}

async fn one_revision_is_approved_at_a_time_and_the_journal_keeps_all(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    store.save(&id, 1, revision("2")).await.unwrap();
    assert_eq!(store.approved(&id).await.unwrap(), None);
    let with_token = Signature { token: Some("t1".to_owned()), ..signature("Ada", 10) };
    let first = approve(&store, &id, 1, None, with_token).await.unwrap();
    assert_eq!((first.kind, first.token.as_deref()), (ApprovalKind::Approved, Some("t1")));
    let second = approve(&store, &id, 2, Some(1), signature("Grace", 20)).await.unwrap();
    assert!(second.sequence > first.sequence);

    let approved = store.approved(&id).await.unwrap().unwrap();
    assert_eq!((approved.revision, approved.who.as_str(), approved.at_ms), (2, "Grace", 20));
    assert_eq!((approved.sequence, &approved.sha256), (second.sequence, &second.sha256));
    assert_eq!(store.specification(&id).await.unwrap().approved(), Some(2));
    let journal = store.approvals(&id, &PageRequest { after: None, limit: 1 }).await.unwrap();
    assert_eq!(journal.rows, [second]);
    let rest = store.approvals(&id, &PageRequest { after: journal.next, limit: 1 }).await.unwrap();
    assert_eq!((rest.rows, rest.next), (vec![first], None));
    let again = approve(&store, &id, 2, Some(2), signature("Ada", 30)).await.unwrap_err();
    assert_eq!(again.to_string(), "revision 2 was approved by Grace");
}

async fn of_two_approvers_at_once_one_wins_and_the_other_learns_who(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    store.save(&id, 1, revision("2")).await.unwrap();
    store.save(&id, 2, revision("3")).await.unwrap();
    let mut expected = None;
    for round in 0..10 {
        let next = |number| expected.map_or(number, |it: u64| 1 + (it - 1 + number) % 3);
        let approvers = [("Ada", next(1)), ("Grace", next(2))].map(|(who, number)| {
            let (store, id) = (store.clone(), id.clone());
            tokio::spawn(async move { approve(&store, &id, number, expected, signature(who, round)).await })
        });
        let mut won = Vec::new();
        let mut lost = Vec::new();
        for approver in approvers {
            match approver.await.unwrap() {
                Ok(row) => won.push(row),
                Err(StoreError::Conflict(conflict)) => lost.push(*conflict),
                Err(error) => panic!("{error}"),
            }
        }
        assert_eq!((won.len(), lost.len()), (1, 1), "round {round}: {won:?}");
        let winner = won.remove(0);
        expected = Some(winner.revision);
        let sentence = format!("revision {} was approved by {}", winner.revision, winner.who);
        assert_eq!(lost[0].to_string(), sentence);
        assert_eq!(lost, [Conflict::Approved(Some(winner))]);
    }
    assert_eq!(store.approvals(&id, &PageRequest::default()).await.unwrap().rows.len(), 10);
    assert_eq!(store.verify().await.unwrap().faults, Vec::<String>::new());
}

async fn what_was_not_looked_at_is_not_approved(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    let head = store.revision(&id, 1).await.unwrap();
    let new = |revision, sha256_seen: &str, expected_approved| NewApproval {
        revision,
        sha256_seen: sha256_seen.to_owned(),
        expected_approved,
        signature: signature("Ada", 1),
    };
    let other = store.approve(&id, new(1, &"0".repeat(64), None)).await.unwrap_err();
    let StoreError::Conflict(conflict) = other else { panic!("{other}") };
    assert_eq!(*conflict, Conflict::OtherContent(head.clone()));
    for number in [0, 2, u64::MAX] {
        let error = store.approve(&id, new(number, &head.sha256, None)).await.unwrap_err();
        assert!(matches!(error, StoreError::NotFound { what: "revision", .. }), "{error}");
    }
    let error = store.approve(&id, new(1, &head.sha256, Some(1))).await.unwrap_err();
    assert_eq!(error.to_string(), "no revision is approved");
    store.delete(&id, 1).await.unwrap();
    let error = store.approve(&id, new(1, &head.sha256, None)).await.unwrap_err();
    assert!(matches!(error, StoreError::NotFound { what: "specification", .. }), "{error}");
    assert_eq!(store.verify().await.unwrap().approvals, 0);
}

async fn a_revoked_approval_leaves_none(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    let nothing = store.revoke(&id, 1, signature("Ada", 1)).await.unwrap_err();
    assert_eq!(nothing.to_string(), "no revision is approved");
    approve(&store, &id, 1, None, signature("Ada", 2)).await.unwrap();
    for number in [0, 2] {
        let other = store.revoke(&id, number, signature("Ada", 3)).await.unwrap_err();
        assert_eq!(other.to_string(), "revision 1 was approved by Ada");
    }
    let revoked = store.revoke(&id, 1, signature("Grace", 4)).await.unwrap();
    assert_eq!((revoked.kind, revoked.revision), (ApprovalKind::Revoked, 1));
    assert_eq!(store.approved(&id).await.unwrap(), None);
    let late = approve(&store, &id, 1, Some(1), signature("Ada", 5)).await.unwrap_err();
    assert_eq!(late.to_string(), "revision 1 was revoked by Grace");
    approve(&store, &id, 1, None, signature("Ada", 6)).await.unwrap();
    assert_eq!(store.verify().await.unwrap().faults, Vec::<String>::new());
}

async fn what_was_approved_at_a_time_follows_the_journal_where_the_clock_went_back(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    store.save(&id, 1, revision("2")).await.unwrap();
    approve(&store, &id, 1, None, signature("Ada", 100)).await.unwrap();
    // The clock was set back by an hour here.
    approve(&store, &id, 2, Some(1), signature("Ada", 40)).await.unwrap();
    store.revoke(&id, 2, signature("Ada", 120)).await.unwrap();
    let mut seen = Vec::new();
    for at_ms in [39, 40, 100, 119, 120] {
        seen.push(store.approved_at(&id, at_ms).await.unwrap().map(|entry| entry.revision));
    }
    assert_eq!(seen, [None, Some(2), Some(2), Some(2), None]);
}

async fn the_latest_approval_of_the_server_is_the_last_that_holds(place: Arc<Place>) {
    let store = place.open().await;
    assert_eq!(store.latest_approved().await.unwrap(), None);
    let mut ids = Vec::new();
    for at_ms in [300, 200, 100] {
        let id = store.create(revision("1")).await.unwrap().id;
        approve(&store, &id, 1, None, signature("Ada", at_ms)).await.unwrap();
        ids.push(id);
    }
    let latest = async || store.latest_approved().await.unwrap().map(|it| it.specification);
    assert_eq!(latest().await.as_ref(), Some(&ids[2]));
    store.revoke(&ids[2], 1, signature("Ada", 50)).await.unwrap();
    assert_eq!(latest().await.as_ref(), Some(&ids[1]));
    let refused = store.delete(&ids[1], 1).await.unwrap_err();
    assert_eq!(refused.to_string(), "revision 1 is approved and may be with a robot; revoke it first");
    store.revoke(&ids[1], 1, signature("Ada", 60)).await.unwrap();
    store.delete(&ids[1], 1).await.unwrap();
    assert_eq!(latest().await.as_ref(), Some(&ids[0]));
    assert_eq!(store.approved(&ids[1]).await.unwrap(), None);
}

async fn verify_finds_a_journal_that_does_not_fit(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    let entry = approve(&store, &id, 1, None, signature("Ada", 1)).await.unwrap();
    place.damage("UPDATE approvals SET sha256 = 'abc'").await;
    place.damage("UPDATE specifications SET approved = 7").await;
    let sequence = entry.sequence;
    let expected = [
        format!(
            "approval {sequence}: specification {id}, revision 1 had the SHA-256 abc, it is now {}",
            entry.sha256
        ),
        format!("specification {id}: approved is revision 7, by the journal revision 1"),
    ];
    assert_eq!(store.verify().await.unwrap().faults, expected);
}
