//! Where sub-goals are: points and balls of the subset on display, seen from one or two sides.

use std::sync::Arc;

use goalgraph::points::{Points, squared_distance};
use goalgraph::specification::{Ball, Specification, SubsetParameters};
use leptos::prelude::*;

use super::{learned, of_subset};
use crate::page::colors::subset_classes;
use crate::page::update::App;
use crate::page::view::plot::{Disk, disks_view};
use crate::protocol::{Cloud, Clusters, Outcome};

/// Points and balls of the subset on display; while another epsilon is tried, those that it gives.
pub(super) fn places(app: App) -> Option<impl IntoView> {
    let (specification, outcome) = learned(app)?;
    let subset = app.derived.tuning.subset.get()?;
    let cloud = outcome.clouds.iter().find(|cloud| cloud.subset == subset.name)?;
    let points = Arc::new(points_of(cloud));
    let none = of_subset(&specification, &subset.name).next().is_none();
    let settled = settled(app, &points, &specification, &outcome, &subset.name);
    let planes = planes(app, &subset, &points, &Arc::new(settled), specification);
    Some(view! {
        <header class="section-head places-head">
            <h2>{subset.name.clone()}</h2>
            <span class="hint">{subset.features.join(", ")}</span>
        </header>
        {none.then(|| view! { <p class="hint">"No sub-goal was found in this subset."</p> })}
        <div class="planes">{planes}</div>
    })
}

fn planes(
    app: App,
    subset: &SubsetParameters,
    points: &Arc<Points>,
    settled: &Arc<Vec<Place>>,
    specification: Arc<Specification>,
) -> impl IntoView + use<> {
    let axes: Vec<&str> = subset.features.iter().map(|name| axis(name)).collect();
    let planes = match axes.len() {
        0 | 1 => vec![(0, 0)],
        2 => vec![(0, 1)],
        _ => vec![(0, 1), (0, 2)],
    };
    let shown = Memo::new({
        let (points, settled) = (Arc::clone(points), Arc::clone(settled));
        move |_| match app.derived.tuning.found.get() {
            Some(found) => Arc::new(tried(app, &points, &specification, &found.subset, &found.clusters)),
            None => Arc::clone(&settled),
        }
    });
    let plane = |(across, up): (usize, usize)| {
        let side = Side { across, up };
        let seen: Vec<(f64, f64)> = points.iter().map(|point| side.seen(point)).collect();
        let around: Vec<Disk> = settled.iter().map(|place| side.disk(place)).collect();
        let disks = move || shown.with(|places| places.iter().map(|place| side.disk(place)).collect());
        disks_view((axes[across], axes[up]), &seen, &around, disks)
    };
    planes.into_iter().map(plane).collect_view()
}

fn axis(feature: &str) -> &str {
    feature.rsplit(['.', '_']).next().unwrap_or(feature)
}

fn points_of(cloud: &Cloud) -> Points {
    Points::from_rows(cloud.dimensions.max(1), cloud.coordinates.iter().map(|&x| f64::from(x)).collect())
}

/// One side from which points are seen.
#[derive(Clone, Copy)]
struct Side {
    across: usize,
    up: usize,
}

impl Side {
    fn seen(self, point: &[f64]) -> (f64, f64) {
        let value = |axis: usize| point.get(axis).copied().unwrap_or(0.0);
        (value(self.across), if self.across == self.up { 0.0 } else { value(self.up) })
    }

    fn disk(self, place: &Place) -> Disk {
        Disk {
            label: place.label.clone(),
            class: place.class.clone(),
            center: self.seen(&place.center),
            radius: place.radius,
            points: place.points.clone(),
        }
    }
}

/// A ball in all dimensions.
#[derive(Clone, Debug, PartialEq)]
struct Place {
    label: String,
    class: String,
    center: Vec<f64>,
    radius: f64,
    /// The points in it, by their positions; none are told apart where it is eliminated.
    points: Vec<usize>,
}

impl Place {
    fn found(points: &Points, label: String, class: &str, (center, radius): (&[f64], f64)) -> Self {
        let inside = |&(_, point): &(usize, &[f64])| squared_distance(point, center) <= radius * radius;
        let points = points.iter().enumerate().filter(inside).map(|(index, _)| index).collect();
        Self { label, class: format!("ball {class}"), center: center.to_vec(), radius, points }
    }

    fn eliminated(center: &[f64], radius: f64) -> Self {
        let class = "ball eliminated gray".to_owned();
        Self { label: String::new(), class, center: center.to_vec(), radius, points: Vec::new() }
    }
}

/// What was learned: eliminated clusters first, so that they lie below.
fn settled(
    app: App,
    points: &Points,
    specification: &Specification,
    outcome: &Outcome,
    subset: &str,
) -> Vec<Place> {
    let eliminated = outcome.eliminated.iter().filter(|cluster| cluster.subset == subset);
    let below = eliminated.map(|cluster| Place::eliminated(&cluster.center, cluster.radius));
    let colors = app.derived.colors.get();
    let above = of_subset(specification, subset).map(|(sub_goal, ball)| {
        let class = colors.get(&sub_goal.id).copied().unwrap_or_default().class();
        Place::found(points, sub_goal.name.clone(), &class, (&ball.center, ball.radius))
    });
    below.chain(above).collect()
}

/// What an epsilon gives. A cluster goes by the names of the sub-goals whose places are in it.
fn tried(
    app: App,
    points: &Points,
    specification: &Specification,
    subset: &str,
    clusters: &Clusters,
) -> Vec<Place> {
    let colors = app.derived.colors.get();
    let below = clusters.eliminated.iter().map(|cluster| Place::eliminated(&cluster.center, cluster.radius));
    let above = clusters.found.iter().map(|cluster| {
        let inside =
            |ball: &Ball| squared_distance(&ball.center, &cluster.center) <= cluster.radius * cluster.radius;
        let held: Vec<_> = of_subset(specification, subset).filter(|(_, ball)| inside(ball)).collect();
        let names: Vec<&str> = held.iter().map(|(sub_goal, _)| sub_goal.name.as_str()).collect();
        let color = held.first().and_then(|(sub_goal, _)| colors.get(&sub_goal.id));
        let class = color.map_or_else(|| subset_class(specification, subset), |color| color.class());
        let label = if names.is_empty() { "new".to_owned() } else { names.join(" + ") };
        Place::found(points, label, &class, (&cluster.center, cluster.radius))
    });
    below.chain(above).collect()
}

fn subset_class(specification: &Specification, subset: &str) -> String {
    let names: Vec<&str> = specification.subsets.iter().map(|it| it.name.as_str()).collect();
    let index = names.iter().position(|name| *name == subset);
    index.and_then(|index| subset_classes(&names).into_iter().nth(index)).unwrap_or_default()
}
