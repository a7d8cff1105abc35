//! The demonstrations that the worker keeps, and the answers that it gives from them. No browser here.

use std::collections::BTreeMap;

use goalgraph::demonstration::Demonstration;
use goalgraph::export::{ExportFormat, export};
use goalgraph::import::{Header, import};
use goalgraph::infer::{InferRequest, infer};
use goalgraph::layout::drawing::layout_request;
use goalgraph::layout::{Direction, Layout, LayoutRequest, layout};
use goalgraph::specification::Specification;
use goalgraph::sub_goal::{Cluster, Eliminated};

use super::looking::{Look, SubsetLook};
use super::opening::{is_specification, opened};
use super::thin::{cloud, track};
use crate::protocol::{
    Completed, DemonstrationEntry, DemonstrationId, EliminatedCluster, FileContent, FileId, FromWorker,
    Outcome, SubsetOf, ToWorker,
};

/// The demonstrations of each file, and the last look at one subset of them.
#[derive(Default)]
pub(super) struct Recordings(BTreeMap<FileId, Vec<Demonstration>>, Option<Look>);

impl Recordings {
    /// Does what `request` asks for; `bytes` are those of the file beside it.
    pub(super) fn serve(
        &mut self,
        request: ToWorker,
        bytes: Option<Result<Vec<u8>, String>>,
        answer: &mut dyn FnMut(FromWorker),
    ) {
        match request {
            ToWorker::Read { file, name } => {
                let bytes = bytes.unwrap_or_else(|| Err("there is no file beside the request".to_owned()));
                answer(match bytes {
                    Ok(bytes) if is_specification(&name, &bytes) => {
                        FromWorker::Opened { file, result: opened(&name, &bytes) }
                    }
                    bytes => {
                        let result = bytes.and_then(|bytes| self.read(file, &name, &bytes));
                        FromWorker::Read { file, result }
                    }
                });
            }
            ToWorker::Forget { file } => {
                self.0.remove(&file);
                self.1 = None;
            }
            ToWorker::Infer { files, request } => {
                let outcome = self.infer(&files, &request, answer);
                answer(FromWorker::Inferred(outcome.map(Box::new)));
            }
            ToWorker::KDistances { of, neighbor, number } => {
                let result = self.look(&of).map(|look| look.k_distances(neighbor));
                answer(FromWorker::KDistances { number, result });
            }
            ToWorker::Preview { of, number } => {
                let result = self.look(&of).map(|look| look.clusters(&of.subset));
                answer(FromWorker::Previewed { number, result });
            }
            ToWorker::Track { demonstration } => {
                if let Some(track) = self.demonstration(demonstration).map(track) {
                    answer(FromWorker::Track { demonstration, track });
                }
            }
            ToWorker::LayOut { specification, number } => {
                answer(FromWorker::LaidOut { number, result: layouts(&specification) });
            }
            ToWorker::Place { request, number } => {
                answer(FromWorker::Placed { number, layout: Some(layout(&request)) });
            }
            ToWorker::DrawSvg { specification } => answer(FromWorker::Svg(svg(&specification))),
        }
    }

    fn read(&mut self, file: FileId, name: &str, bytes: &[u8]) -> Result<FileContent, String> {
        let demonstrations = import(name, bytes, Header::Detect).map_err(|error| error.to_string())?;
        let first = demonstrations.first().ok_or("there are no demonstrations in it")?;
        let content = FileContent {
            sha256: first.sha256().to_owned(),
            features: first.features().to_vec(),
            demonstrations: demonstrations.iter().map(entry).collect(),
        };
        self.0.insert(file, demonstrations);
        Ok(content)
    }

    fn demonstration(&self, id: DemonstrationId) -> Option<&Demonstration> {
        self.0.get(&id.file)?.get(id.index)
    }

    /// The subset that `of` names; looking again at the same files costs nothing.
    fn look(&mut self, of: &SubsetOf) -> Result<SubsetLook<'_>, String> {
        let known = self.1.take().filter(|look| look.is_of(&of.files, &of.request));
        let demonstrations = &self.0;
        let all =
            || of.files.iter().filter_map(|file| demonstrations.get(file)).flatten().collect::<Vec<_>>();
        self.1.insert(known.unwrap_or_else(|| Look::new(&of.files, &of.request, &all()))).subset(of)
    }

    fn infer(
        &mut self,
        files: &[FileId],
        request: &InferRequest,
        answer: &mut dyn FnMut(FromWorker),
    ) -> Result<Outcome, String> {
        let (demonstrations, counts) = self.take_in_order(files);
        let outcome = outcome(&demonstrations, request, answer);
        self.put_back(demonstrations, &counts);
        outcome
    }

    /// All demonstrations of `files` in one row, and how many each file has. They are moved: there may be gigabytes.
    fn take_in_order(&mut self, files: &[FileId]) -> (Vec<Demonstration>, Vec<(FileId, usize)>) {
        let mut row = Vec::new();
        let mut counts = Vec::new();
        for &file in files {
            let demonstrations = self.0.remove(&file).unwrap_or_default();
            counts.push((file, demonstrations.len()));
            row.extend(demonstrations);
        }
        (row, counts)
    }

    fn put_back(&mut self, row: Vec<Demonstration>, counts: &[(FileId, usize)]) {
        let mut row = row.into_iter();
        for &(file, count) in counts {
            self.0.insert(file, row.by_ref().take(count).collect());
        }
    }
}

fn outcome(
    demonstrations: &[Demonstration],
    request: &InferRequest,
    answer: &mut dyn FnMut(FromWorker),
) -> Result<Outcome, String> {
    let progress = &mut |progress: &_| answer(FromWorker::Progress(Clone::clone(progress)));
    let inference = infer(demonstrations, request, progress).map_err(|error| error.to_string())?;
    let subsets = &inference.specification.subsets;
    let clouds = subsets.iter().map(|subset| cloud(demonstrations, &subset.name, &subset.features)).collect();
    let words = inference.specification.demonstrations.iter().map(|it| it.word.clone());
    let completed = words.zip(inference.completed).map(|(word, frames)| Completed { word, frames }).collect();
    Ok(Outcome {
        specification: inference.specification.to_json(),
        completed,
        eliminated: inference.eliminated.into_iter().map(eliminated).collect(),
        notes: inference.notes,
        clouds,
    })
}

fn entry(demonstration: &Demonstration) -> DemonstrationEntry {
    let frames = demonstration.frames();
    let undefined_in = |frame| demonstration.frame(frame).iter().filter(|value| value.is_nan()).count();
    let undefined = (0..frames).map(undefined_in).sum();
    DemonstrationEntry { name: demonstration.name().to_owned(), frames, undefined }
}

/// A cluster that is no sub-goal, as it travels to the page.
pub(super) fn eliminated(eliminated: Eliminated) -> EliminatedCluster {
    let Eliminated { cluster: Cluster { ball, frames, demonstrations }, reason } = eliminated;
    let (subset, center, radius) = (ball.subset, ball.center, ball.radius);
    EliminatedCluster { subset, center, radius, frames, demonstrations, reason }
}

/// The layouts from left to right and from top to bottom.
fn layouts(specification: &str) -> Result<Vec<Layout>, String> {
    let specification = Specification::from_json(specification).map_err(|error| error.to_string())?;
    let request = layout_request(&specification);
    let directions = [Direction::LeftToRight, Direction::TopToBottom];
    Ok(directions.map(|direction| layout(&LayoutRequest { direction, ..request.clone() })).into())
}

fn svg(specification: &str) -> Result<String, String> {
    let specification = Specification::from_json(specification).map_err(|error| error.to_string())?;
    Ok(export(&specification, ExportFormat::Svg))
}
