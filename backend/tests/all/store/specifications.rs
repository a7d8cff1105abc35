//! Specifications and their revisions.

use std::sync::Arc;

use goalgraph_server::store::{Conflict, MAX_PAGE, NewRevision, PageRequest, Store, StoreError};

use super::place::{Place, on_every_database, revision};

on_every_database! {
    what_is_saved_is_read_back,
    names_are_kept_whatever_they_are_made_of,
    a_text_that_not_every_database_can_hold_is_refused,
    a_save_upon_an_old_revision_tells_what_was_saved_meanwhile,
    of_many_who_save_at_once_one_wins,
    pages_show_every_specification_once_while_others_are_added,
    pages_of_revisions_are_newest_first_whatever_the_clock_said,
    a_page_is_asked_for_by_its_own_place_only,
    a_deleted_specification_is_hidden_and_nothing_of_it_is_lost,
    changed_content_is_found_when_it_is_read,
    nothing_is_found_under_ids_and_numbers_of_nothing,
}

async fn what_is_saved_is_read_back(place: Arc<Place>) {
    let store = place.open().await;
    let first = store.create(revision("{}")).await.unwrap();
    // echo -n '{}' | sha256sum
    assert_eq!(first.sha256, "44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a");
    assert_eq!((first.head, first.approved(), first.author.as_str()), (1, None, "Ada"));
    assert_eq!(first.id.len(), 32);

    let new =
        NewRevision { positions: Some("{\"q0\":[1,2]}".to_owned()), saved_at_ms: 2_000, ..revision("[]") };
    let second = store.save(&first.id, 1, new).await.unwrap();
    assert_eq!((second.number, second.saved_at_ms), (2, 2_000));
    store.close().await;

    let store = place.open().await;
    assert_eq!(store.revision(&first.id, 2).await.unwrap(), second);
    assert_eq!(store.revision(&first.id, 1).await.unwrap().positions, None);
    assert_eq!(store.content(&first.id, 1).await.unwrap(), "{}");
    assert_eq!(store.content(&first.id, 2).await.unwrap(), "[]");
    let now = store.specification(&first.id).await.unwrap();
    assert_eq!((now.head, now.created_at_ms, now.saved_at_ms), (2, 1_000, 2_000));
    assert_eq!(store.specifications(&PageRequest::default()).await.unwrap().rows, [now]);
}

async fn names_are_kept_whatever_they_are_made_of(place: Arc<Place>) {
    let store = place.open().await;
    let long = "x".repeat(100_000);
    let names = [
        "",
        " ",
        "'; DROP TABLE revisions; --",
        "\"$1\" \\ % _ ?",
        "line\r\nline\t\u{7f}\u{1b}[31m",
        "Größe 机器人 🤖 e\u{301} \u{202e}abc",
        &long,
    ];
    for name in names {
        let new = NewRevision {
            name: name.to_owned(),
            author: name.to_owned(),
            message: name.to_owned(),
            positions: Some(name.to_owned()),
            ..revision(name)
        };
        let id = store.create(new).await.unwrap().id;
        let found = store.revision(&id, 1).await.unwrap();
        assert_eq!([&found.name, &found.author, &found.message], [name; 3]);
        assert_eq!(found.positions.as_deref(), Some(name));
        assert_eq!(store.content(&id, 1).await.unwrap(), name);
    }
}

async fn a_text_that_not_every_database_can_hold_is_refused(place: Arc<Place>) {
    let store = place.open().await;
    let new = NewRevision { author: "A\0da".to_owned(), ..revision("{}") };
    let error = store.create(new).await.unwrap_err();
    assert_eq!(error.to_string(), "the author holds a NUL character");
    assert_eq!(store.specifications(&PageRequest::default()).await.unwrap().rows, []);
}

async fn a_save_upon_an_old_revision_tells_what_was_saved_meanwhile(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    let theirs = NewRevision { author: "Grace".to_owned(), ..revision("2") };
    let theirs = store.save(&id, 1, theirs).await.unwrap();
    for based_on in [1, 3, 0, u64::MAX] {
        let error = store.save(&id, based_on, revision("mine")).await.unwrap_err();
        let StoreError::Conflict(conflict) = error else { panic!("{error}") };
        assert_eq!(conflict.to_string(), "revision 2 was saved meanwhile by Grace");
        assert_eq!(*conflict, Conflict::Saved(theirs.clone()));
    }
    assert_eq!(store.revisions(&id, &PageRequest::default()).await.unwrap().rows.len(), 2);
}

async fn of_many_who_save_at_once_one_wins(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("0")).await.unwrap().id;
    for round in 1..=5 {
        let savers: Vec<_> = (0..8)
            .map(|saver| {
                let (store, id) = (store.clone(), id.clone());
                let content = format!("{round} by {saver}");
                tokio::spawn(async move { store.save(&id, round, revision(&content)).await })
            })
            .collect();
        let mut won = Vec::new();
        let mut seen = Vec::new();
        for saver in savers {
            match saver.await.unwrap() {
                Ok(row) => won.push(row),
                Err(StoreError::Conflict(conflict)) => seen.push(*conflict),
                Err(error) => panic!("{error}"),
            }
        }
        assert_eq!(won.len(), 1, "{won:?}");
        assert_eq!(seen, vec![Conflict::Saved(won.remove(0)); 7]);
    }
    assert_eq!(store.specification(&id).await.unwrap().head, 6);
}

async fn all_ids(store: &Store, limit: u32, after_each_page: impl AsyncFn()) -> Vec<String> {
    let mut ids = Vec::new();
    let mut request = PageRequest { after: None, limit };
    loop {
        let page = store.specifications(&request).await.unwrap();
        assert!(page.rows.len() <= limit as usize);
        ids.extend(page.rows.into_iter().map(|row| row.id));
        after_each_page().await;
        let Some(next) = page.next else { return ids };
        request.after = Some(next);
    }
}

async fn pages_show_every_specification_once_while_others_are_added(place: Arc<Place>) {
    let store = place.open().await;
    let mut expected = Vec::new();
    for number in 0..7 {
        expected.insert(0, store.create(revision(&number.to_string())).await.unwrap().id);
    }
    assert_eq!(all_ids(&store, 7, async || {}).await, expected);
    let add = async || {
        store.create(revision("another")).await.unwrap();
    };
    assert_eq!(all_ids(&store, 2, add).await, expected);

    // What is saved again comes first.
    let oldest = expected.pop().unwrap();
    store.save(&oldest, 1, revision("newer")).await.unwrap();
    assert_eq!(all_ids(&store, 3, async || {}).await[0], oldest);
}

async fn pages_of_revisions_are_newest_first_whatever_the_clock_said(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("1")).await.unwrap().id;
    for (based_on, saved_at_ms) in [(1, 500), (2, -7), (3, 400), (4, i64::MAX)] {
        let new = NewRevision { saved_at_ms, ..revision("later") };
        store.save(&id, based_on, new).await.unwrap();
    }
    let page = store.revisions(&id, &PageRequest { after: None, limit: 2 }).await.unwrap();
    assert_eq!(page.rows.iter().map(|row| row.number).collect::<Vec<_>>(), [5, 4]);
    let rest = store.revisions(&id, &PageRequest { after: page.next, limit: 9 }).await.unwrap();
    let rest: Vec<_> = rest.rows.iter().map(|row| (row.number, row.saved_at_ms)).collect();
    assert_eq!(rest, [(3, -7), (2, 500), (1, 1_000)]);
}

async fn a_page_is_asked_for_by_its_own_place_only(place: Arc<Place>) {
    let store = place.open().await;
    for after in ["x", "", "1.5", "9223372036854775808", "'"] {
        let request = PageRequest { after: Some(after.to_owned()), limit: 1 };
        let error = store.specifications(&request).await.unwrap_err();
        assert_eq!(error.to_string(), format!("{after:?} is not where a page begins"));
    }
    let id = store.create(revision("1")).await.unwrap().id;
    for limit in [0, 1, MAX_PAGE + 1, u32::MAX] {
        let page = store.revisions(&id, &PageRequest { after: None, limit }).await.unwrap();
        assert_eq!((page.rows.len(), page.next), (1, None));
    }
}

async fn a_deleted_specification_is_hidden_and_nothing_of_it_is_lost(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("{}")).await.unwrap().id;
    let later = store.delete(&id, 2).await.unwrap_err();
    assert!(
        matches!(later, StoreError::Conflict(_)),
        "what was saved meanwhile is not deleted unseen: {later}"
    );
    store.delete(&id, 1).await.unwrap();
    let gone = format!("there is no specification {id}");
    assert_eq!(store.specification(&id).await.unwrap_err().to_string(), gone);
    assert_eq!(store.save(&id, 1, revision("2")).await.unwrap_err().to_string(), gone);
    assert_eq!(store.delete(&id, 1).await.unwrap_err().to_string(), gone);
    assert_eq!(store.revisions(&id, &PageRequest::default()).await.unwrap_err().to_string(), gone);
    assert!(matches!(store.content(&id, 1).await, Err(StoreError::NotFound { .. })));
    assert_eq!(store.specifications(&PageRequest::default()).await.unwrap().rows, []);
    assert_eq!(store.verify().await.unwrap().revisions, 1);
}

async fn changed_content_is_found_when_it_is_read(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("{\"weight\":1}")).await.unwrap().id;
    let intact = store.create(revision("{\"weight\":1}")).await.unwrap().id;
    let damage = format!("UPDATE revisions SET content = '{{\"weight\":7}}' WHERE specification = '{id}'");
    place.damage(&damage).await;
    let fault = format!("specification {id}, revision 1: the content has the SHA-256 ");
    let error = store.content(&id, 1).await.unwrap_err();
    assert!(matches!(&error, StoreError::Corrupt(found) if found.starts_with(&fault)), "{error}");
    store.content(&intact, 1).await.unwrap();
    let report = store.verify().await.unwrap();
    assert_eq!(report.revisions, 2);
    assert_eq!([format!("damaged: {}", report.faults[0])], [error.to_string()]);
    assert_eq!(report.faults.len(), 1);
}

async fn nothing_is_found_under_ids_and_numbers_of_nothing(place: Arc<Place>) {
    let store = place.open().await;
    let id = store.create(revision("{}")).await.unwrap().id;
    for number in [0, 2, u64::MAX] {
        let error = store.revision(&id, number).await.unwrap_err();
        assert_eq!(error.to_string(), format!("there is no revision {number} of specification {id}"));
        assert!(matches!(store.content(&id, number).await, Err(StoreError::NotFound { .. })));
    }
    for other in ["", "x", "' OR ''='", "\u{1f916}"] {
        assert!(matches!(store.specification(other).await, Err(StoreError::NotFound { .. })));
        assert!(matches!(store.save(other, 1, revision("1")).await, Err(StoreError::NotFound { .. })));
    }
}
