//! Planes: paths, points and balls seen from one side.

use leptos::prelude::*;

use crate::page::geometry::{Plane, Range, dots, line, round_length};
use crate::page::labels::{Label, Spot, spots};
use crate::page::text::significant;

/// Width and height of a plane; it keeps its shape on the page.
const SIZE: (f64, f64) = (420.0, 300.0);
const MARGIN: f64 = 24.0;
/// Radius of the dot where a path ends.
const END: f64 = 4.5;
/// The smallest radius of a disk.
const SMALLEST: f64 = 3.0;

/// The path of one thing, with gaps.
pub(crate) struct Trace {
    /// Its name.
    pub(crate) name: String,
    /// The class that gives its color.
    pub(crate) class: String,
    /// Its places in the order of time.
    pub(crate) points: Vec<Option<(f64, f64)>>,
}

/// A ball seen as a disk.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Disk {
    /// What is written beside it.
    pub(crate) label: String,
    /// The classes that give its look.
    pub(crate) class: String,
    /// Its center.
    pub(crate) center: (f64, f64),
    /// Its radius.
    pub(crate) radius: f64,
    /// The points in it, by their positions.
    pub(crate) points: Vec<usize>,
}

/// Paths with their starts and ends.
pub(crate) fn plane_view((across, up): (&str, &str), traces: &[Trace]) -> impl IntoView + use<> {
    let points = || traces.iter().flat_map(|trace| trace.points.iter().flatten().copied());
    let plane = plane_of(points());
    let end = |trace: &Trace| trace.points.iter().flatten().next_back().map(|&point| plane.place(point));
    let path = |trace: &Trace| {
        let placed = trace.points.iter().map(|point| point.map(|point| plane.place(point)));
        let start = trace.points.iter().flatten().next().map(|&point| plane.place(point));
        view! {
            <g class=format!("trace {}", trace.class)>
                <path class="trace-line" d=line(placed) />
                {start.map(|(x, y)| view! { <circle class="trace-start" cx=x.to_string() cy=y.to_string() r="3.5" /> })}
                {end(trace).map(|(x, y)| view! { <circle class="trace-end" cx=x.to_string() cy=y.to_string() r=END.to_string() /> })}
            </g>
        }
    };
    let paths = traces.iter().map(path).collect_view();
    let label = |trace: &Trace| {
        Some((trace.class.clone(), Label { name: shortened(&trace.name), place: end(trace)?, radius: END }))
    };
    let names = names(traces.iter().filter_map(label).collect());
    framed((across, up), &plane, view! { {paths} {names} }.into_any())
}

/// Points, and over them the balls, which may change; the plane shows all points and has room for the balls `around`.
pub(crate) fn disks_view<F: Fn() -> Vec<Disk> + Send + 'static>(
    (across, up): (&str, &str),
    points: &[(f64, f64)],
    around: &[Disk],
    disks: F,
) -> impl IntoView + use<F> {
    let rim = |disk: &Disk| {
        let ((x, y), r) = (disk.center, disk.radius);
        [(x - r, y - r), (x + r, y + r)]
    };
    let plane = plane_of(points.iter().copied().chain(around.iter().flat_map(rim)));
    let dot_of = |&point: &(f64, f64)| dots(std::iter::once(plane.place(point)));
    let dot_of: Vec<String> = points.iter().map(dot_of).collect();
    let cloud = dot_of.concat();
    let radius = move |disk: &Disk| (disk.radius * plane.scale()).max(SMALLEST);
    let disk = move |disk: &Disk| {
        let ((x, y), radius) = (plane.place(disk.center), radius(disk));
        let inside: String = disk.points.iter().map(|&point| dot_of[point].as_str()).collect();
        view! {
            <g class=disk.class.clone()>
                {(!inside.is_empty()).then(|| view! { <path class="ball-points" d=inside /> })}
                <circle class="ball-rim" cx=format!("{x:.1}") cy=format!("{y:.1}") r=format!("{radius:.1}") />
            </g>
        }
    };
    let label = move |disk: &Disk| {
        let label =
            Label { name: shortened(&disk.label), place: plane.place(disk.center), radius: radius(disk) };
        (disk.class.clone(), label)
    };
    let all = move || {
        let disks = disks();
        let named = disks.iter().filter(|disk| !disk.label.is_empty());
        view! { {disks.iter().map(&disk).collect_view()} {names(named.map(label).collect())} }
    };
    framed((across, up), &plane, view! { <path class="cloud" d=cloud /> {all} }.into_any())
}

/// Names with the classes of what they name. What was drawn last lies on top, so its name is the one right beside.
fn names(mut named: Vec<(String, Label)>) -> impl IntoView {
    named.reverse();
    let (classes, labels): (Vec<String>, Vec<Label>) = named.into_iter().unzip();
    let above_the_scale_bar = (SIZE.0, SIZE.1 - 16.0);
    let spots = spots(&labels, above_the_scale_bar);
    let spotted = classes.into_iter().zip(labels).zip(spots);
    spotted.filter_map(|((class, label), spot)| Some(name(class, label.name, spot?))).collect_view()
}

fn name(class: String, name: String, Spot { near: (x, y), at_left, leader }: Spot) -> impl IntoView {
    let anchor = if at_left { "end" } else { "start" };
    let leader = leader.map(|ends| view! { <path class="leader" d=line(ends.into_iter().map(Some)) /> });
    view! {
        <g class=class>
            {leader}
            <text x=format!("{x:.1}") y=format!("{:.1}", y + 4.0) text-anchor=anchor>{name}</text>
        </g>
    }
}

/// The start of a name that is too long to stand beside anything.
fn shortened(name: &str) -> String {
    const LONGEST: usize = 26;
    if name.chars().count() <= LONGEST {
        return name.to_owned();
    }
    name.chars().take(LONGEST - 1).chain(['…']).collect()
}

fn plane_of(points: impl Iterator<Item = (f64, f64)> + Clone) -> Plane {
    let unit = Range { low: 0.0, high: 1.0 };
    let x = Range::of(points.clone().map(|point| point.0)).unwrap_or(unit);
    let y = Range::of(points.map(|point| point.1)).unwrap_or(unit);
    Plane::new(x, y, SIZE, MARGIN)
}

/// The frame around a plane: names of its axes and a scale bar.
fn framed((across, up): (&str, &str), plane: &Plane, content: AnyView) -> impl IntoView + use<> {
    let (width, height) = SIZE;
    let length = round_length((width - 2.0 * MARGIN) / plane.scale());
    let bar = length * plane.scale();
    let (left, bottom) = (MARGIN, height - 10.0);
    let title = match (across, up) {
        ("x", "y") => "From above".to_owned(),
        ("x", "z") => "From the side".to_owned(),
        _ => format!("{across} and {up}"),
    };
    let label = format!("{title}: {across} to the right, {up} up");
    view! {
        <figure class="plane">
            <figcaption><strong>{title}</strong> <span class="hint">{format!("{across} right, {up} up")}</span></figcaption>
            <svg viewBox=format!("0 0 {width} {height}") role="img" aria-label=label>
                {content}
                <path class="scale-bar" d=format!("M{left} {:.1}v6h{bar:.1}v-6", bottom - 6.0) />
                <text class="scale-text" x=format!("{:.1}", left + bar + 6.0) y=format!("{bottom:.1}")>{significant(length)}</text>
            </svg>
        </figure>
    }
}
