//! Another epsilon is tried on the subset on display.

use std::sync::Arc;

use goalgraph::infer::InferRequest;
use leptos::prelude::*;

use crate::protocol::{Clusters, FileId, KDistanceCurve};

/// An epsilon that somebody holds on to, or has just let go of.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Attempt {
    /// Name of the subset.
    pub(crate) subset: String,
    /// The epsilon.
    pub(crate) epsilon: f64,
    /// Whether it was let go of, so that the inference runs with it.
    pub(crate) released: bool,
}

/// A search that the worker was asked for, and not yet answered.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct UnderWay {
    /// The number of the request.
    pub(crate) number: u32,
    /// Name of the subset.
    pub(crate) subset: String,
    /// The epsilon.
    pub(crate) epsilon: f64,
}

/// What an epsilon finds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Found {
    /// Name of the subset.
    pub(crate) subset: String,
    /// The epsilon.
    pub(crate) epsilon: f64,
    /// The clusters.
    pub(crate) clusters: Arc<Clusters>,
}

/// What decides about a curve: the same cause gives the same curve.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CurveOf {
    /// The files, in the order of their demonstrations.
    pub(crate) files: Vec<FileId>,
    /// What is inferred from them, without the parameters of the subsets.
    pub(crate) request: InferRequest,
    /// Name of the subset.
    pub(crate) subset: String,
    /// To which neighbor the distances are.
    pub(crate) neighbor: usize,
}

/// The curve that was asked for last.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Curve {
    /// The number of the request.
    pub(crate) number: u32,
    /// Of what it was asked for.
    pub(crate) of: Option<CurveOf>,
    /// The last answer, and of what it is.
    pub(crate) answer: Option<(CurveOf, Result<Arc<KDistanceCurve>, String>)>,
}

/// The ground state of it.
#[derive(Default)]
pub(crate) struct Tuning {
    /// How far points are from their neighbors.
    pub(crate) curve: RwSignal<Curve>,
    /// The epsilon that is tried.
    pub(crate) attempt: RwSignal<Option<Attempt>>,
    /// The search that is under way: one at most.
    pub(crate) under_way: RwSignal<Option<UnderWay>>,
    /// The number of the last search.
    pub(crate) searches: RwSignal<u32>,
    /// What the last search found.
    pub(crate) found: RwSignal<Option<Found>>,
}
