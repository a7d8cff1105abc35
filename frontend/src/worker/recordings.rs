//! The demonstrations that the worker keeps, and the answers that it gives from them. No browser here.

use std::collections::BTreeMap;

use goalgraph::demonstration::Demonstration;
use goalgraph::export::{ExportFormat, export};
use goalgraph::infer::{InferRequest, Inference, Progress, Study};
use goalgraph::layout::drawing::layout_request;
use goalgraph::layout::{Direction, Layout, LayoutRequest, layout};
use goalgraph::specification::{Specification, SubsetParameters};
use goalgraph::sub_goal::{Cluster, Eliminated};
use goalgraph::subset::SubsetRequest;

use super::looking::{clusters, curve_of};
use super::reading::Content;
use super::thin::{cloud, track};
use crate::protocol::{
    Completed, DemonstrationEntry, DemonstrationId, EliminatedCluster, FileContent, FileId, FromWorker,
    Outcome, ReadFile, SubsetOf, ToWorker,
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
    /// Keeps what was read from a file, and says what it is.
    pub(super) fn keep(&mut self, file: FileId, content: Result<Content, String>) -> FromWorker {
        let result = match content {
            Ok(Content::Specification(result)) => return FromWorker::Opened { file, result },
            Ok(Content::Demonstrations(demonstrations)) => {
                let first = demonstrations.first();
                let content = FileContent {
                    sha256: first.map(|it| it.sha256().to_owned()).unwrap_or_default(),
                    features: first.map(|it| it.features().to_vec()).unwrap_or_default(),
                    demonstrations: demonstrations.iter().map(entry).collect(),
                };
                self.demonstrations.insert(file, demonstrations);
                Ok(content)
            }
            Err(reason) => Err(reason),
        };
        FromWorker::Read(vec![ReadFile { file, result }])
    }

    /// Does what `request` asks for.
    pub(super) fn serve(&mut self, request: ToWorker, answer: &mut dyn FnMut(FromWorker)) {
        match request {
            // Files are read by whoever has them, and kept by [`Recordings::keep`].
            ToWorker::Read(_) => {}
            ToWorker::Forget { file } => {
                self.demonstrations.remove(&file);
                if self.demonstrations.is_empty() {
                    *self = Self::default();
                }
            }
            ToWorker::Infer { files, request } => {
                let demonstrations = self.row(&files);
                let progress = &mut |progress: &Progress| answer(FromWorker::Progress(progress.clone()));
                let inference = self.infer(&files, &request, progress);
                answer(inferred(&demonstrations, inference));
            }
            ToWorker::KDistances { of, neighbor, number } => {
                let result = self.study_of(&of).and_then(|study| {
                    let recording = study.recording(&of.subset).ok_or_else(|| unknown(&of))?;
                    Ok(curve_of(recording, neighbor))
                });
                answer(FromWorker::KDistances { number, result });
            }
            ToWorker::Preview { of, number } => {
                let result = self.study_of(&of).and_then(|study| {
                    let search = study.sub_goals(&of.subset, of.request.radius);
                    search.map(clusters).ok_or_else(|| unknown(&of))
                });
                answer(FromWorker::Previewed { number, result });
            }
            ToWorker::Track { demonstration } => {
                if let Some(track) = self.demonstration(demonstration).map(track) {
                    answer(FromWorker::Track { demonstration, track });
                }
            }
            ToWorker::LayOut { specification, number } => {
                let read = Specification::from_json(&specification).map_err(|error| error.to_string());
                answer(FromWorker::LaidOut {
                    number,
                    result: read.map(|specification| layouts(&specification)),
                });
            }
            ToWorker::Place { request, number } => {
                answer(FromWorker::Placed { number, layout: Some(layout(&request)) });
            }
            ToWorker::DrawSvg { specification } => answer(FromWorker::Svg(svg(&specification))),
        }
    }

    fn demonstration(&self, id: DemonstrationId) -> Option<&Demonstration> {
        self.demonstrations.get(&id.file)?.get(id.index)
    }

    /// All demonstrations of `files` in one row. They share their values with those that are kept.
    pub(super) fn row(&self, files: &[FileId]) -> Vec<Demonstration> {
        files.iter().filter_map(|file| self.demonstrations.get(file)).flatten().cloned().collect()
    }

    /// Forgets what is known from the last inference.
    pub(super) fn forget_study(&mut self) {
        (self.study, self.studied) = (Study::default(), None);
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
    ) -> Result<Inference, String> {
        let demonstrations = self.row(files);
        let inference = self.study.infer(&demonstrations, request, progress);
        let inference = inference.map_err(|error| error.to_string())?;
        let subset = |known: &SubsetParameters| SubsetRequest {
            name: known.name.clone(),
            features: known.features.clone(),
            ..SubsetRequest::default()
        };
        let subsets = inference.specification.subsets.iter().map(subset).collect();
        self.studied = Some((files.to_vec(), InferRequest { subsets, ..request.clone() }));
        Ok(inference)
    }
}

/// What is said of an inference from `demonstrations`.
pub(super) fn inferred(demonstrations: &[Demonstration], inference: Result<Inference, String>) -> FromWorker {
    match inference {
        Ok(inference) => {
            let layouts = layouts(&inference.specification);
            FromWorker::Inferred { result: Ok(Box::new(outcome(demonstrations, inference))), layouts }
        }
        Err(reason) => FromWorker::Inferred { result: Err(reason), layouts: Vec::new() },
    }
}

fn outcome(demonstrations: &[Demonstration], inference: Inference) -> Outcome {
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
fn layouts(specification: &Specification) -> Vec<Layout> {
    let request = layout_request(specification);
    let directions = [Direction::LeftToRight, Direction::TopToBottom];
    directions.map(|direction| layout(&LayoutRequest { direction, ..request.clone() })).into()
}

fn svg(specification: &str) -> Result<String, String> {
    let specification = Specification::from_json(specification).map_err(|error| error.to_string())?;
    Ok(export(&specification, ExportFormat::Svg))
}
