//! Runs and their events.

use std::sync::Arc;

use goalgraph_server::store::{
    Appended, Conflict, NewEvent, NewRun, PageRequest, RunChange, RunFilter, StoreError,
};

use super::place::{Place, on_every_database, revision, run_of};

on_every_database! {
    a_run_begins_once_however_often_it_is_begun,
    events_are_stored_once_in_their_order_without_gaps,
    a_batch_is_stored_up_to_what_does_not_fit,
    events_sent_over_two_connections_are_stored_once,
    events_keep_their_numbers_when_the_clock_goes_back,
    runs_are_listed_newest_first_by_specification_and_state,
    verify_finds_a_lost_event,
}

fn event(number: u64, event: &str) -> NewEvent {
    NewEvent { number, event: event.to_owned(), robot_at_ms: None, received_at_ms: 5 }
}

async fn a_run_begins_once_however_often_it_is_begun(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("1")).await.unwrap();
    let new = run_of(&specification, "run 1");
    let first = store.begin_run(new.clone()).await.unwrap();
    assert_eq!((first.state.as_str(), first.is_open(), first.last_event), ("started", true, 0));
    assert_eq!(store.begin_run(NewRun { at_ms: 9_999, ..new.clone() }).await.unwrap(), first);
    let other = NewRun { executor: "arm 2".to_owned(), ..new.clone() };
    let error = store.begin_run(other).await.unwrap_err();
    assert_eq!(error.to_string(), "there is another run run 1 of arm 1");
    assert!(matches!(error, StoreError::Conflict(conflict) if *conflict == Conflict::Run(first)));
    let nowhere = NewRun { id: "run 2".to_owned(), revision: 2, ..new.clone() };
    assert!(matches!(store.begin_run(nowhere).await, Err(StoreError::NotFound { what: "revision", .. })));

    let begin = || {
        let (store, new) = (store.clone(), NewRun { id: "run 3".to_owned(), ..new.clone() });
        tokio::spawn(async move { store.begin_run(new).await.unwrap() })
    };
    let [one, two, three] = [begin(), begin(), begin()];
    let one = one.await.unwrap();
    assert_eq!([two.await.unwrap(), three.await.unwrap()], [one.clone(), one]);
}

async fn events_are_stored_once_in_their_order_without_gaps(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("1")).await.unwrap();
    store.begin_run(run_of(&specification, "r")).await.unwrap();
    let append = async |number, text: &str| store.append_event("r", event(number, text)).await.unwrap();
    assert_eq!(append(2, "b").await, Appended::Gap { expected: 1 });
    assert_eq!(append(1, "a").await, Appended::Stored);
    assert_eq!(append(1, "a").await, Appended::Known);
    assert_eq!(append(1, "A").await, Appended::Different);
    assert_eq!(append(0, "a").await, Appended::Different);
    assert_eq!(append(3, "c").await, Appended::Gap { expected: 2 });
    assert_eq!(append(u64::MAX, "z").await, Appended::Gap { expected: 2 });
    assert_eq!(append(2, "b").await, Appended::Stored);
    assert_eq!(store.run("r").await.unwrap().last_event, 2);

    // The same event is known by what the robot said, not by when it came.
    let later = NewEvent { received_at_ms: 77, ..event(2, "b") };
    assert_eq!(store.append_event("r", later).await.unwrap(), Appended::Known);
    let other = NewEvent { robot_at_ms: Some(3), ..event(2, "b") };
    assert_eq!(store.append_event("r", other).await.unwrap(), Appended::Different);

    let events = store.events("r", 0, 10).await.unwrap();
    let seen: Vec<_> = events.iter().map(|it| (it.number, it.event.as_str(), it.received_at_ms)).collect();
    assert_eq!(seen, [(1, "a", 5), (2, "b", 5)]);
    let missing = store.append_event("x", event(1, "a")).await.unwrap_err();
    assert_eq!(missing.to_string(), "there is no run x");
    assert!(matches!(store.events("x", 0, 1).await, Err(StoreError::NotFound { what: "run", .. })));
}

async fn a_batch_is_stored_up_to_what_does_not_fit(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("1")).await.unwrap();
    store.begin_run(run_of(&specification, "r")).await.unwrap();
    store.append_event("r", event(1, "a")).await.unwrap();
    let batch = [event(1, "a"), event(2, "b"), event(3, "c"), event(3, "C"), event(4, "d")];
    let outcomes = store.append_events("r", &batch).await.unwrap();
    assert_eq!(outcomes, [Appended::Known, Appended::Stored, Appended::Stored, Appended::Different]);
    let outcomes = store.append_events("r", &[event(5, "e"), event(4, "d")]).await.unwrap();
    assert_eq!(outcomes, [Appended::Gap { expected: 4 }]);
    let nul = store.append_events("r", &[event(4, "d"), event(5, "\0")]).await.unwrap_err();
    assert_eq!(nul.to_string(), "the event holds a NUL character");
    assert_eq!(store.append_events("r", &[]).await.unwrap(), []);
    let events = store.events("r", 1, 10).await.unwrap();
    assert_eq!(events.iter().map(|it| it.event.as_str()).collect::<Vec<_>>(), ["b", "c"]);
    assert_eq!(store.events("r", 1, 1).await.unwrap().len(), 1);
    assert_eq!(store.events("r", u64::MAX, 10).await.unwrap(), []);
}

async fn events_sent_over_two_connections_are_stored_once(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("1")).await.unwrap();
    store.begin_run(run_of(&specification, "r")).await.unwrap();
    let send = || {
        let store = store.clone();
        tokio::spawn(async move {
            let mut stored = 0;
            for number in 1..=20 {
                match store.append_event("r", event(number, "same")).await.unwrap() {
                    Appended::Stored => stored += 1,
                    outcome => assert_eq!(outcome, Appended::Known),
                }
            }
            stored
        })
    };
    let (one, two) = (send(), send());
    assert_eq!(one.await.unwrap() + two.await.unwrap(), 20);
    let numbers: Vec<u64> = store.events("r", 0, 100).await.unwrap().iter().map(|it| it.number).collect();
    assert_eq!(numbers, (1..=20).collect::<Vec<_>>());
    assert_eq!(store.verify().await.unwrap().faults, Vec::<String>::new());
}

async fn events_keep_their_numbers_when_the_clock_goes_back(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("1")).await.unwrap();
    store.begin_run(run_of(&specification, "r")).await.unwrap();
    for (number, robot_at_ms) in [(1, Some(900)), (2, Some(-4)), (3, None), (4, Some(i64::MIN))] {
        let new = NewEvent { robot_at_ms, received_at_ms: -1, ..event(number, "e") };
        assert_eq!(store.append_event("r", new).await.unwrap(), Appended::Stored);
    }
    let events = store.events("r", 0, 10).await.unwrap();
    let times: Vec<_> = events.iter().map(|it| it.robot_at_ms).collect();
    assert_eq!(times, [Some(900), Some(-4), None, Some(i64::MIN)]);
}

async fn runs_are_listed_newest_first_by_specification_and_state(place: Arc<Place>) {
    let store = place.open().await;
    let (one, two) = (store.create(revision("1")).await.unwrap(), store.create(revision("2")).await.unwrap());
    for (specification, id) in [(&one, "a"), (&two, "b"), (&one, "c"), (&one, "d")] {
        store.begin_run(run_of(specification, id)).await.unwrap();
    }
    let change = RunChange {
        state: "finished".to_owned(),
        is_open: false,
        at_ms: 9,
        summary: Some("{\"steps\":4}".to_owned()),
    };
    let ended = store.set_run_state("c", change.clone()).await.unwrap();
    assert_eq!((ended.state.as_str(), ended.is_open(), ended.changed_at_ms), ("finished", false, 9));
    assert_eq!(ended.summary, change.summary);
    let again = RunChange { summary: None, is_open: true, ..change };
    assert_eq!(store.set_run_state("d", again.clone()).await.unwrap().summary, None);
    let unknown = store.set_run_state("x", again).await.unwrap_err();
    assert_eq!(unknown.to_string(), "there is no run x");

    let ids = async |specification: Option<&str>, open_only| {
        let filter = RunFilter { specification: specification.map(str::to_owned), open_only };
        let page = store.runs(&filter, &PageRequest::default()).await.unwrap();
        page.rows.iter().map(|row| row.id.as_str()).collect::<String>()
    };
    assert_eq!(ids(None, false).await, "dcba");
    assert_eq!(ids(Some(&one.id), false).await, "dca");
    assert_eq!(ids(Some(&one.id), true).await, "da");
    assert_eq!(ids(Some(""), false).await, "");
    let page = store.runs(&RunFilter::default(), &PageRequest { after: None, limit: 3 }).await.unwrap();
    let rest = store.runs(&RunFilter::default(), &PageRequest { after: page.next, limit: 3 }).await.unwrap();
    assert_eq!((page.rows.len(), rest.rows[0].id.as_str(), rest.next), (3, "a", None));
}

async fn verify_finds_a_lost_event(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("1")).await.unwrap();
    store.begin_run(run_of(&specification, "r")).await.unwrap();
    store.append_events("r", &[event(1, "a"), event(2, "b"), event(3, "c")]).await.unwrap();
    assert_eq!(store.verify().await.unwrap().events, 3);
    place.damage("DELETE FROM run_events WHERE number = 2").await;
    let faults = store.verify().await.unwrap().faults;
    assert_eq!(faults, ["run \"r\": 2 events from 1 to 3, but 3 is the newest"]);
}
