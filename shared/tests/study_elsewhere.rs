//! Subsets studied by workers that share no memory: what travels is data, and the inference is the same.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, import};
use goalgraph::infer::{
    DemonstrationKey, DemonstrationKeys, Found, InferRequest, Inference, Method, Seen, SubsetStudy, conclude,
    infer, requested_subsets, tell,
};
use goalgraph::points::Track;
use goalgraph::rest::SubsetStays;
use goalgraph::subset::SubsetRequest;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// What comes out at the other end of a wire.
fn sent<T: Serialize + DeserializeOwned>(value: &T) -> T {
    serde_json::from_str(&serde_json::to_string(value).unwrap()).unwrap()
}

/// A worker with its own memory, for one subset.
#[derive(Default)]
struct Worker(SubsetStudy);

impl Worker {
    /// `tracks` are those of all demonstrations, of which it takes what it does not know.
    fn look(
        &mut self,
        subset: &SubsetRequest,
        method: Method,
        keys: &[DemonstrationKey],
        tracks: &[Track],
    ) -> Seen {
        self.0.look(&subset.name, &subset.features, method, keys, |index| tracks[index].clone());
        self.0.seen()
    }

    fn search(
        &mut self,
        subset: &SubsetRequest,
        request: &InferRequest,
        stays: Option<SubsetStays>,
    ) -> Found {
        self.0.set_stays(stays);
        self.0.search(subset, request.radius);
        self.0.found().unwrap().clone()
    }
}

/// Whoever asks the workers: it has the demonstrations, and looks at none of their values.
struct Coordinator {
    keys: DemonstrationKeys,
    subsets: Vec<SubsetStudy>,
    workers: Vec<Worker>,
}

impl Coordinator {
    fn infer(&mut self, demonstrations: &[Demonstration], request: &InferRequest) -> Inference {
        let subsets = requested_subsets(demonstrations, request).unwrap();
        let keys = self.keys.number(demonstrations);
        self.subsets.resize_with(subsets.len(), SubsetStudy::default);
        self.workers.resize_with(subsets.len(), Worker::default);
        for ((subset, study), worker) in subsets.iter().zip(&mut self.subsets).zip(&mut self.workers) {
            let track = |index: usize| Track::of_features(&demonstrations[index], &subset.features);
            let tracks: Vec<Track> = (0..keys.len()).map(track).collect();
            let seen = worker.look(&sent(subset), request.method, &sent(&keys), &sent(&tracks));
            study.look_through(&subset.name, &subset.features, &keys, track, sent(&seen));
        }
        tell(&mut self.subsets);
        let pairs = subsets.iter().zip(&self.subsets).zip(&mut self.workers);
        let search = |((subset, study), worker): ((&SubsetRequest, &SubsetStudy), &mut Worker)| {
            let (_, stays) = study.recording();
            sent(&worker.search(&sent(subset), request, sent(&stays.cloned())))
        };
        let found: Vec<Found> = pairs.map(search).collect();
        conclude(demonstrations, request, &found.iter().collect::<Vec<_>>())
    }
}

#[test]
fn workers_that_share_no_memory_infer_the_same() {
    let task = goalgraph_tasks::tower(3, 6);
    let read = |index| import("tower.csv", task.csv(index).as_bytes(), Header::Detect).unwrap();
    let all: Vec<Demonstration> = (0..6).flat_map(read).collect();
    let mut coordinator =
        Coordinator { keys: DemonstrationKeys::default(), subsets: Vec::new(), workers: Vec::new() };
    for method in [Method::AtRest, Method::Published] {
        let request = InferRequest { method, ..InferRequest::default() };
        for range in [0..3, 0..4, 1..6, 0..6] {
            let demonstrations = &all[range];
            let expected = infer(demonstrations, &request, &mut |_| {}).unwrap();
            assert_eq!(coordinator.infer(demonstrations, &request), expected);
        }
    }
}
