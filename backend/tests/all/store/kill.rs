//! A program that is killed while it writes.

use std::env;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use goalgraph_server::store::{Appended, Location, NewEvent, Store, StoreOptions};

use super::demonstrations::put;
use super::place::{Place, on_every_database, revision, run_of};

on_every_database! {
    what_was_acknowledged_survives_a_kill_at_any_moment_and_nothing_is_half_written,
}

const KILLS: u64 = 15;
const DATA: &str = "GOALGRAPH_TEST_KILLED_DATA";
const DATABASE: &str = "GOALGRAPH_TEST_KILLED_DATABASE";
const SPECIFICATION: &str = "GOALGRAPH_TEST_KILLED_SPECIFICATION";

async fn what_was_acknowledged_survives_a_kill_at_any_moment_and_nothing_is_half_written(place: Arc<Place>) {
    let store = place.open().await;
    let specification = store.create(revision("1")).await.unwrap();
    store.begin_run(run_of(&specification, "r")).await.unwrap();
    store.close().await;
    for round in 0..KILLS {
        let mut writer = start_writer(&place, &specification.id);
        let acknowledged = kill_after(&mut writer, 1 + round % 4, Duration::from_micros(700 * round));
        let store = place.open().await;
        let report = store.verify().await.unwrap();
        assert_eq!(report.faults, Vec::<String>::new());
        // What was under way when it was killed may be stored as well: one revision or event.
        let (head, last) = acknowledged;
        assert!((head..=head + 1).contains(&report.revisions), "{acknowledged:?} {report:?}");
        assert!((last..=last + 1).contains(&report.events), "{acknowledged:?} {report:?}");
        store.close().await;
    }
}

/// Starts [`writes_until_it_is_killed`] in a process of its own.
fn start_writer(place: &Place, specification: &str) -> Child {
    let location = place.location();
    let mut command = Command::new(env::current_exe().unwrap());
    command.args(["store::kill::writes_until_it_is_killed", "--exact", "--ignored", "--nocapture"]);
    command.env(DATA, location.data).env(SPECIFICATION, specification).stdout(Stdio::piped());
    if let Some(url) = location.database {
        command.env(DATABASE, url);
    }
    command.spawn().unwrap()
}

/// Reads `lines` acknowledgements, waits a little and kills the writer; returns the last revision and event acknowledged.
fn kill_after(writer: &mut Child, lines: u64, moment: Duration) -> (u64, u64) {
    let mut printed = BufReader::new(writer.stdout.take().unwrap()).lines().map(Result::unwrap);
    let mut seen = (0, 0);
    let mut see = |line: &str| {
        let mut words = line.split(' ').skip_while(|word| *word != "acknowledged").skip(1);
        let numbers = words.next().zip(words.next());
        if let Some((head, last)) = numbers {
            seen = (head.parse().unwrap(), last.parse().unwrap());
        }
        numbers.is_some()
    };
    let mut left = lines;
    while left > 0 {
        let line = printed.next().expect("the writer goes on until it is killed");
        left -= u64::from(see(&line));
    }
    thread::sleep(moment);
    writer.kill().unwrap();
    writer.wait().unwrap();
    for line in printed {
        see(&line);
    }
    seen
}

/// Saves, reports and uploads without end, and prints the numbers of what is acknowledged.
#[tokio::test]
#[ignore = "no test of its own: the one above starts and kills it"]
async fn writes_until_it_is_killed() {
    sqlx::any::install_default_drivers();
    let data = env::var_os(DATA).expect("the test above starts this");
    let location = Location { data: data.into(), database: env::var(DATABASE).ok() };
    let store = Store::open(&location, StoreOptions::default()).await.unwrap();
    let id = env::var(SPECIFICATION).unwrap();
    let mut head = store.specification(&id).await.unwrap().head;
    let mut last = store.run("r").await.unwrap().last_event;
    println!("acknowledged {head} {last}");
    loop {
        let content = format!("{head} {}", "x".repeat(9_000));
        head = store.save(&id, head, revision(&content)).await.unwrap().number;
        println!("acknowledged {head} {last}");
        let event =
            NewEvent { number: last + 1, event: "{}".to_owned(), robot_at_ms: None, received_at_ms: 1 };
        assert_eq!(store.append_event("r", event).await.unwrap(), Appended::Stored);
        last += 1;
        println!("acknowledged {head} {last}");
        put(&store, "demo.csv", &[&head.to_string()]).await.unwrap();
    }
}
