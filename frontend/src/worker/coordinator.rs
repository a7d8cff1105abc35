//! The worker that the page talks to: keeps the demonstrations, answers from them, and shares out what is large.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use futures_util::{StreamExt, stream};
use goalgraph::demonstration::Demonstration;
use goalgraph::infer::{InferRequest, Inference, Progress, requested_subsets};
use goalgraph::subset::SubsetRequest;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::{File, MessageEvent};

use super::answers::{Answers, answer};
use super::parcel::Parcel;
use super::piece::{Outcome, Piece};
use super::pool::{Pool, WORTH_INFERRING, WORTH_READING};
use super::recordings::{Recordings, inferred};
use super::shared_study::SharedStudy;
use super::task::{Done, Task};
use super::{file, scope, warm_up};
use crate::protocol::{FileId, FileToRead, FromWorker, ToWorker, decode};

/// Starts to listen to the page, and says so.
pub(super) fn start() {
    let coordinator = Rc::new(Coordinator {
        jobs: RefCell::default(),
        busy: Cell::default(),
        recordings: RefCell::default(),
        study: RefCell::default(),
        pool: Pool::of_scope(),
    });
    let listener = Rc::clone(&coordinator);
    let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        if let Some(job) = job_of(&event) {
            listener.add(job);
        }
    });
    scope().set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    on_message.forget();
    answer(&FromWorker::Ready);
    answer(&FromWorker::Rehearsal(warm_up::warm_up()));
    // Nothing to read: only so that the first job is not the first that is done.
    coordinator.add((ToWorker::Read(Vec::new()), Vec::new()));
}

/// A request and the files that it is about.
type Job = (ToWorker, Vec<File>);

/// Jobs are done one after the other, in the order in which they came.
struct Coordinator {
    jobs: RefCell<VecDeque<Job>>,
    busy: Cell<bool>,
    recordings: RefCell<Recordings>,
    /// What is known of the demonstrations from the last inference in which the pool took part.
    study: RefCell<SharedStudy>,
    pool: Pool,
}

impl Coordinator {
    fn add(self: &Rc<Self>, job: Job) {
        self.jobs.borrow_mut().push_back(job);
        if !self.busy.replace(true) {
            spawn_local(Rc::clone(self).work());
        }
    }

    async fn work(self: Rc<Self>) {
        loop {
            let job = self.jobs.borrow_mut().pop_front();
            match job {
                None => break,
                Some((ToWorker::Read(requests), files)) => {
                    self.read(requests.into_iter().zip(files).collect()).await;
                }
                Some((ToWorker::Infer { files, request }, _)) if self.is_shared(&files, &request) => {
                    self.infer(&files, &request).await;
                }
                Some((request, _)) if self.answer_from_study(&request) => {}
                Some((request, _)) => {
                    if matches!(request, ToWorker::Infer { .. } | ToWorker::Forget { .. }) {
                        self.study.take();
                    }
                    self.recordings.borrow_mut().serve(request, &mut |message| answer(&message));
                }
            }
        }
        self.busy.set(false);
    }

    async fn read(&self, mut files: Vec<(FileToRead, File)>) {
        let bytes = files.iter().map(|(_, file)| file.size()).sum();
        let answers = Answers::default();
        let keep = |request: &FileToRead, content| {
            answers.add(self.recordings.borrow_mut().keep(request.file, content));
        };
        if files.len() > 1 && self.pool.takes(bytes, WORTH_READING) {
            // The largest first, so that nobody waits for it in the end.
            files.sort_by(|(_, a), (_, b)| b.size().total_cmp(&a.size()));
            let tasks = files.iter().map(|(request, file)| {
                Parcel::with_file(&Task::Read { name: request.name.clone() }, file.clone())
            });
            let done = |index: usize, parcel: Result<Parcel, String>| {
                let content = parcel
                    .and_then(|Parcel { head, values, .. }| decode::<Done>(&head)?.into_content(values));
                keep(&files[index].0, content);
            };
            self.pool.run(tasks, &done).await;
        } else {
            // While one is read the browser fetches the next; small ones it fetches side by side.
            let ahead = if bytes < file::SMALL { files.len() } else { 2 };
            let contents = stream::iter(&files)
                .map(async |(request, file)| (request, file::load(file).await))
                .buffered(ahead.max(1));
            let mut contents = std::pin::pin!(contents);
            while let Some((request, loaded)) = contents.next().await {
                keep(request, loaded.and_then(|loaded| loaded.content(&request.name)));
            }
        }
        answers.give();
    }

    /// Answers what is asked about one subset from what is known of the last inference in which the pool took part; tells
    /// whether that is known.
    fn answer_from_study(&self, request: &ToWorker) -> bool {
        let (ToWorker::KDistances { of, .. } | ToWorker::Preview { of, .. }) = request else { return false };
        let demonstrations = self.recordings.borrow().row(&of.files);
        let known = self.study.borrow().answer(&demonstrations, request);
        known.iter().for_each(answer);
        known.is_some()
    }

    /// Whether to infer from `files` together with the pool.
    fn is_shared(&self, files: &[FileId], request: &InferRequest) -> bool {
        let demonstrations = self.recordings.borrow().row(files);
        let values: usize = demonstrations.iter().map(|it| it.values().len()).sum();
        let several = |subsets: Vec<SubsetRequest>| subsets.len() > 1;
        self.pool.takes(8.0 * values as f64, WORTH_INFERRING)
            && requested_subsets(&demonstrations, request).is_ok_and(several)
    }

    async fn infer(&self, files: &[FileId], request: &InferRequest) {
        self.recordings.borrow_mut().forget_study();
        let demonstrations = self.recordings.borrow().row(files);
        let inference = self.inference(demonstrations.clone(), request).await;
        answer(&inferred(&demonstrations, inference));
    }

    async fn inference(
        &self,
        demonstrations: Vec<Demonstration>,
        request: &InferRequest,
    ) -> Result<Inference, String> {
        let study = &self.study;
        study.borrow_mut().begin(demonstrations, request).map_err(|error| error.to_string())?;
        let (subsets, looks) = (study.borrow().subsets(), study.borrow().to_look());
        // As elsewhere: every subset is looked at and clustered, and then the words are read.
        let steps = |first: usize| Steps { first, total: 2 * subsets + 1 };
        self.share(
            "Looking at",
            steps(subsets - looks.len()),
            &looks,
            |study, &index| study.look(index),
            |study, &index, outcome| {
                if let Outcome::Seen(seen) = outcome {
                    study.saw(index, seen);
                }
            },
        )
        .await?;
        study.borrow_mut().tell();
        let searches = study.borrow().to_search(request);
        self.share(
            "Clustering",
            steps(2 * subsets - searches.len()),
            &searches,
            |study, (index, search)| study.search(*index, search),
            |study, (index, search), outcome| {
                if let Outcome::Found(Some(found)) = outcome {
                    study.found(*index, search.clone(), found);
                }
            },
        )
        .await?;
        Ok(study.borrow().conclude(request))
    }

    /// Has the pool do a piece for each of `parts`, which is a step each; `take` takes what came of it.
    async fn share<T>(
        &self,
        stage: &str,
        steps: Steps,
        parts: &[T],
        piece: impl Fn(&SharedStudy, &T) -> (Piece, Vec<f64>),
        take: impl Fn(&mut SharedStudy, &T, Outcome),
    ) -> Result<(), String> {
        if parts.is_empty() {
            return Ok(());
        }
        let said = |count: usize| {
            let stage = format!("{stage} {} subset{}", parts.len(), if parts.len() == 1 { "" } else { "s" });
            answer(&FromWorker::Progress(Progress { stage, done: steps.first + count, total: steps.total }));
        };
        let (count, failed) = (Cell::new(0), RefCell::new(None));
        let tasks = parts.iter().map(|part| {
            let (piece, values) = piece(&self.study.borrow(), part);
            Parcel::new(&Task::Infer(Box::new(piece)), values)
        });
        let done = |index: usize, parcel: Result<Parcel, String>| {
            match parcel.and_then(|parcel| decode::<Done>(&parcel.head)) {
                Ok(Done::Inferred(outcome)) => take(&mut self.study.borrow_mut(), &parts[index], outcome),
                Ok(_) => drop(failed.replace(Some("a worker did something else".to_owned()))),
                Err(reason) => drop(failed.replace(Some(reason))),
            }
            count.set(count.get() + 1);
            said(count.get());
        };
        said(0);
        self.pool.run(tasks, &done).await;
        failed.take().map_or(Ok(()), Err)
    }
}

/// Where among the steps of an inference some of them are.
#[derive(Clone, Copy)]
struct Steps {
    /// How many come before.
    first: usize,
    /// How many there are.
    total: usize,
}

/// A message is an array: the request, then the files where there are some.
fn job_of(event: &MessageEvent) -> Option<Job> {
    let parts: js_sys::Array = event.data().dyn_into().ok()?;
    let request = decode(&js_sys::Uint8Array::new(&parts.shift()).to_vec()).ok()?;
    Some((request, parts.iter().filter_map(|part| part.dyn_into().ok()).collect()))
}
