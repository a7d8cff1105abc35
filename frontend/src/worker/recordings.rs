//! The demonstrations that the worker keeps, and the answers that it gives from them. No browser here.

use std::collections::BTreeMap;

use goalgraph::demonstration::Demonstration;
use goalgraph::export::{ExportFormat, export};
use goalgraph::import::{Header, import};
use goalgraph::infer::{InferRequest, Inference, Progress, Study};
use goalgraph::layout::drawing::layout_request;
use goalgraph::layout::{Direction, Layout, LayoutRequest, layout};
use goalgraph::specification::{Specification, SubsetParameters};
use goalgraph::sub_goal::{Cluster, Eliminated};
use goalgraph::subset::SubsetRequest;

use super::looking::{clusters_of, curve_of};
use super::opening::{is_specification, opened};
use super::thin::{cloud, track};
use crate::protocol::{
    Completed, DemonstrationEntry, DemonstrationId, EliminatedCluster, FileContent, FileId, FromWorker,
    Outcome, SubsetOf, ToWorker,
};

/// The demonstrations of each file, and what is known of them from the last inference.
#[derive(Default)]
pub(super) struct Recordings {
    demonstrations: BTreeMap<FileId, Vec<Demonstration>>,
    study: Study,
    /// From which files the last inference was, and how, with all its subsets but without their parameters.
    studied: Option<(Vec<FileId>, InferRequest)>,
}

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
                self.demonstrations.remove(&file);
                if self.demonstrations.is_empty() {
                    *self = Self::default();
                }
            }
            ToWorker::Infer { files, request } => {
                let outcome = self.outcome(&files, &request, answer);
                answer(FromWorker::Inferred(outcome.map(Box::new)));
            }
            ToWorker::KDistances { of, neighbor, number } => {
                let curve = self.study_of(&of).map(|study| curve_of(study, &of, neighbor));
                let result = curve.and_then(|curve| curve.ok_or_else(|| unknown(&of)));
                answer(FromWorker::KDistances { number, result });
            }
            ToWorker::Preview { of, number } => {
                let clusters = self.study_of(&of).map(|study| clusters_of(study, &of));
                let result = clusters.and_then(|clusters| clusters.ok_or_else(|| unknown(&of)));
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
        self.demonstrations.insert(file, demonstrations);
        Ok(content)
    }

    fn demonstration(&self, id: DemonstrationId) -> Option<&Demonstration> {
        self.demonstrations.get(&id.file)?.get(id.index)
    }

    /// What is known of the subsets of `of`: as a rule from the last inference.
    fn study_of(&mut self, of: &SubsetOf) -> Result<&Study, String> {
        let known =
            self.studied.as_ref().is_some_and(|known| *known == (of.files.clone(), of.request.clone()));
        if !known {
            self.infer(&of.files, &of.request, &mut |_| {})?;
        }
        Ok(&self.study)
    }

    /// Infers, and remembers what was learned on the way.
    fn infer(
        &mut self,
        files: &[FileId],
        request: &InferRequest,
        progress: &mut dyn FnMut(&Progress),
    ) -> Result<(Inference, Vec<Demonstration>), String> {
        let known = files.iter().filter_map(|file| self.demonstrations.get(file));
        let row: Vec<Demonstration> = known.flatten().cloned().collect();
        let inference = self.study.infer(&row, request, progress).map_err(|error| error.to_string())?;
        let subset = |known: &SubsetParameters| SubsetRequest {
            name: known.name.clone(),
            features: known.features.clone(),
            ..SubsetRequest::default()
        };
        let subsets = inference.specification.subsets.iter().map(subset).collect();
        self.studied = Some((files.to_vec(), InferRequest { subsets, ..request.clone() }));
        Ok((inference, row))
    }

    fn outcome(
        &mut self,
        files: &[FileId],
        request: &InferRequest,
        answer: &mut dyn FnMut(FromWorker),
    ) -> Result<Outcome, String> {
        let progress = &mut |progress: &_| answer(FromWorker::Progress(Clone::clone(progress)));
        let (inference, row) = self.infer(files, request, progress)?;
        Ok(outcome(inference, &row))
    }
}

fn outcome(inference: Inference, demonstrations: &[Demonstration]) -> Outcome {
    let subsets = &inference.specification.subsets;
    let clouds = subsets.iter().map(|subset| cloud(demonstrations, &subset.name, &subset.features)).collect();
    let words = inference.specification.demonstrations.iter().map(|it| it.word.clone());
    let completed = words.zip(inference.completed).map(|(word, frames)| Completed { word, frames }).collect();
    Outcome {
        specification: inference.specification.to_json(),
        completed,
        eliminated: inference.eliminated.into_iter().map(eliminated).collect(),
        notes: inference.notes,
        clouds,
    }
}

fn unknown(of: &SubsetOf) -> String {
    format!("there is no subset {}", of.subset.name)
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
