//! What follows from trying another epsilon.

use std::sync::Arc;

use goalgraph::infer::InferRequest;
use goalgraph::specification::{Specification, SubsetParameters};
use goalgraph::subset::{Setting, SubsetRequest};
use leptos::prelude::*;

use crate::page::model::{Basis, CurveOf, Found, Model, Tab};
use crate::protocol::{KDistanceCurve, SubsetOf};

/// Memos about the subset on display.
pub(crate) struct Tuning {
    /// The subset on display, with the parameters that it was searched with.
    pub(crate) subset: Memo<Option<SubsetParameters>>,
    /// Where the worker can search it; none where its recordings are not here or were chosen otherwise since.
    pub(crate) of: Memo<Option<SubsetOf>>,
    /// The curve to ask for; none while nobody would see it.
    pub(crate) wanted: Memo<Option<CurveOf>>,
    /// The curve of the subset on display, or why there is none; none until the worker has answered.
    pub(crate) curve: Memo<Option<Result<Arc<KDistanceCurve>, String>>>,
    /// What the epsilon that is tried finds in the subset on display.
    pub(crate) found: Memo<Option<Found>>,
}

impl Tuning {
    /// The memos over `model`.
    pub(super) fn of(
        model: &'static Model,
        specification: Memo<Option<Arc<Specification>>>,
        subsets: Memo<Vec<SubsetRequest>>,
        basis: Memo<Option<Basis>>,
    ) -> Self {
        let subset = Memo::new(move |_| {
            let specification = specification.get()?;
            let last = specification.subsets.len().checked_sub(1)?;
            specification.subsets.get(model.subset.get().min(last)).cloned()
        });
        let of = Memo::new(move |_| {
            let (subset, Basis { files, mut request }) = (subset.get()?, basis.get()?);
            request.subsets = subsets.get();
            let is_it = |it: &&SubsetRequest| it.name == subset.name && it.features == subset.features;
            let subset = request.subsets.iter().find(is_it).cloned()?;
            Some(SubsetOf { files, request: without_parameters(request), subset })
        });
        let wanted = Memo::new(move |_| {
            let is_seen = model.tab.get() == Tab::SubGoals && model.inferring.with(Option::is_none);
            let (of, subset) = (of.get().filter(|_| is_seen)?, subset.get()?);
            let SubsetOf { files, request, .. } = of;
            Some(CurveOf { files, request, subset: subset.name, neighbor: subset.min_points })
        });
        let curve = Memo::new(move |_| {
            let (of, subset) = (of.get()?, subset.get()?);
            let (curve_of, curve) = model.tuning.curve.with(|curve| curve.answer.clone())?;
            // Until that to another neighbor is there, it is better than none.
            let is_it = curve_of.subset == subset.name && curve_of.files == of.files;
            (is_it && curve_of.request == of.request).then_some(curve)
        });
        let found = Memo::new(move |_| {
            let name = subset.get()?.name;
            let is_tried = model.tuning.attempt.with(|it| it.as_ref().is_some_and(|it| it.subset == name));
            model.tuning.found.get().filter(|found| is_tried && found.subset == name)
        });
        Self { subset, of, wanted, curve, found }
    }
}

/// The request with all parameters left to the engine: the points that are clustered do not depend on what they are
/// clustered with.
fn without_parameters(mut request: InferRequest) -> InferRequest {
    for subset in &mut request.subsets {
        subset.epsilon = Setting::Auto;
        subset.min_points = Setting::Auto;
        subset.restored.clear();
    }
    request
}
