//! What the server is asked for to watch runs.

use std::sync::Arc;

use goalgraph::specification::Specification;
use leptos::prelude::*;
use wasm_bindgen_futures::spawn_local;

use crate::page::model::{EventLog, Notice};
use crate::page::server;
use crate::page::update::App;

impl App {
    /// Fetches the events of a run from the first that is missing on, as long as it is the one that is looked at.
    pub(super) fn fetch_events(self, run: String) {
        let log = self.model.watching.log;
        if log.with_untracked(|log| log.run != run) {
            log.set(EventLog { run: run.clone(), ..EventLog::default() });
        }
        log.update(|log| log.fetching = true);
        let number = |log: &EventLog| log.events.len() as u64;
        let announced = {
            let run = run.clone();
            move || {
                let shown = self.derived.watched.run;
                shown.with_untracked(|it| it.as_ref().filter(|it| it.run == run).map_or(0, |it| it.events))
            }
        };
        spawn_local(async move {
            let failed = loop {
                let (after, announced_before) = (log.with_untracked(number), announced());
                let answer = server::events(&run, after).await;
                if log.with_untracked(|log| log.run != run) {
                    // Another run is looked at meanwhile.
                    return;
                }
                let page = match answer {
                    Err(reason) => break Some(reason.to_string()),
                    Ok(page) => page,
                };
                let more = page.next.is_some() && !page.items.is_empty();
                log.update(|log| {
                    for event in page.items {
                        if event.number == number(log) + 1 {
                            log.events.push(event);
                        }
                    }
                });
                let (here, announced) = (log.with_untracked(number), announced());
                // A server that does not give what it had announced when it was asked is not asked for ever.
                let may_come = here > after || announced > announced_before;
                if !more && (here >= announced || !may_come) {
                    break None;
                }
            };
            log.update(|log| {
                log.fetching = false;
                log.failed = failed;
            });
        });
    }

    /// Fetches runs from before those that are known.
    pub(super) fn fetch_older(self) {
        let older = self.model.watching.older;
        if older.with_untracked(|older| older.fetching || older.complete) {
            return;
        }
        older.update(|older| older.fetching = true);
        spawn_local(async move {
            let after = older.with_untracked(|older| older.next.clone());
            let answer = server::runs(after.as_deref()).await;
            older.update(|older| older.fetching = false);
            match answer {
                Ok(page) => {
                    older.update(|older| {
                        older.complete = page.next.is_none();
                        older.next = page.next;
                    });
                    self.model.watching.heard.update(|heard| heard.take_older(page.items));
                }
                Err(reason) => self.say(Notice::alarm(format!("Older runs are not listed: {reason}."))),
            }
        });
    }

    /// Fetches a specification that runs follow, for names and for the replay.
    pub(super) fn fetch_revision(self, specification: String, number: u64, sha256: String) {
        spawn_local(async move {
            let read = read(&specification, number).await;
            if let Err(reason) = &read {
                self.say(Notice::alarm(format!("r{number}, which the run follows, is not shown: {reason}.")));
            }
            self.model.watching.followed.update(|followed| {
                followed.insert(sha256, read.ok().map(Arc::new));
            });
        });
    }
}

async fn read(specification: &str, number: u64) -> Result<Specification, String> {
    let answer = server::revision(specification, number).await.map_err(|failure| failure.to_string())?;
    Specification::from_json(&answer.value.content).map_err(|error| error.to_string())
}
