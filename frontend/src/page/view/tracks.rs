//! One demonstration over time and in space.

use std::sync::Arc;

use goalgraph::demonstration::Feature;
use goalgraph::subset::SubsetRequest;
use leptos::prelude::*;

use super::plot::{Trace, plane_view};
use crate::page::colors::subset_classes;
use crate::page::geometry::{Range, line};
use crate::page::text::{count, significant};
use crate::page::update::App;
use crate::protocol::Track;

/// Width and height of a chart in its own units; it is stretched to the page.
const CHART: (f64, f64) = (1000.0, 100.0);

/// What is drawn: a track, and where the features of each subset are in it.
struct Recording {
    track: Arc<Track>,
    subsets: Vec<RecordedSubset>,
}

/// A subset, where its features are in the track, and its color.
struct RecordedSubset {
    name: String,
    axes: Vec<String>,
    columns: Vec<usize>,
    class: String,
}

/// The canvas of the Demonstrations tab.
pub(crate) fn tracks(app: App) -> impl IntoView {
    move || {
        let Some((name, recording)) = recording(app) else {
            return view! { <p class="nothing">"Select a demonstration to see its recording."</p> }
                .into_any();
        };
        let moment = app.model.moment.get();
        let charts =
            recording.subsets.iter().map(|subset| chart(&recording.track, subset, moment)).collect_view();
        let frames = count(recording.track.frames, "frame");
        view! {
            <header class="section-head"><h2>{name}</h2> <span class="hint">{frames}</span></header>
            <h3>"In space"</h3>
            <div class="planes">{planes(&recording)}</div>
            <h3>"Over time"</h3>
            {charts}
        }
        .into_any()
    }
}

fn recording(app: App) -> Option<(String, Recording)> {
    let shown = app.model.demonstration.get()?;
    let (of, track) = app.model.track.get()?;
    let accepted = app.derived.accepted.get();
    let (_, content) = accepted.iter().find(|(file, _)| *file == shown.file && of == shown)?;
    let name = content.demonstrations.get(shown.index)?.name.clone();
    let subsets = app.derived.subsets.get();
    let names: Vec<&str> = subsets.iter().map(|subset| subset.name.as_str()).collect();
    let recorded = |(subset, class): (&SubsetRequest, String)| RecordedSubset {
        name: subset.name.clone(),
        axes: subset.features.iter().map(|name| short(name)).collect(),
        columns: columns(subset, &content.features),
        class,
    };
    let subsets = subsets.iter().zip(subset_classes(&names)).map(recorded).collect();
    Some((name, Recording { track, subsets }))
}

fn columns(subset: &SubsetRequest, features: &[Feature]) -> Vec<usize> {
    let column = |name: &String| features.iter().position(|feature| feature.name == *name);
    subset.features.iter().filter_map(column).collect()
}

/// The values of a subset's features over time.
fn chart(
    track: &Track,
    RecordedSubset { name, axes, columns, class }: &RecordedSubset,
    moment: Option<usize>,
) -> impl IntoView + use<> {
    let values = columns.iter().flat_map(|&column| track.column(column).flatten()).map(f64::from);
    let range = Range::of(values);
    let shown = range.unwrap_or(Range { low: 0.0, high: 1.0 });
    let lines = columns.iter().enumerate().map(|(style, &column)| {
        view! { <path class=format!("line l{}", style % 6) d=time_line(track, column, shown) /> }
    });
    let keys = axes.iter().cloned().enumerate().map(|(style, axis)| {
        view! { <li><svg class="key" width="18" height="8" aria-hidden="true">
        <path class=format!("line l{}", style % 6) d="M1 4h16" /></svg> {axis}</li> }
    });
    let label = format!("{name} over time");
    let (width, height) = CHART;
    let moment = moment.map(|frame| {
        let x = width * frame as f64 / track.frames.max(2) as f64;
        view! { <path class="moment" d=format!("M{x:.1} 0V{height}")><title>{format!("frame {frame}")}</title></path> }
    });
    view! {
        <figure class="chart">
            <figcaption>
                <span class=format!("dot {class}")></span>
                <strong>{name.clone()}</strong>
                <ul class="keys">{keys.collect_view()}</ul>
                {range.is_none().then(|| view! { <span class="tag">"never observed"</span> })}
            </figcaption>
            <div class="chart-scale" aria-hidden="true">
                <span>{significant(shown.high)}</span><span>{significant(shown.low)}</span>
            </div>
            <svg class="chart-area" viewBox=format!("0 0 {width} {height}") preserveAspectRatio="none" role="img" aria-label=label>
                {gaps(track, columns)}
                {lines.collect_view()}
                {moment}
            </svg>
        </figure>
    }
}

/// The end of a feature's name: its axis.
fn short(name: &str) -> String {
    name.rsplit(['.', '_']).next().unwrap_or(name).to_owned()
}

fn time_line(track: &Track, column: usize, range: Range) -> String {
    let (width, height) = CHART;
    let step = width * track.stride as f64 / track.frames.max(2) as f64;
    let place = |(frame, value): (usize, Option<f32>)| {
        let share = (f64::from(value?) - range.low) / range.length();
        Some((frame as f64 * step, height * (0.95 - 0.9 * share)))
    };
    line(track.column(column).enumerate().map(place))
}

/// Hatched where a feature of the subset was not observed.
fn gaps(track: &Track, columns: &[usize]) -> impl IntoView + use<> {
    let (width, height) = CHART;
    let frames = track.values.len() / track.features.max(1);
    let missing =
        |frame: usize| columns.iter().any(|&column| track.values[frame * track.features + column].is_none());
    let step = width * track.stride as f64 / track.frames.max(2) as f64;
    let mut spans: Vec<(usize, usize)> = Vec::new();
    for frame in (0..frames).filter(|&frame| missing(frame)) {
        match spans.last_mut() {
            Some((_, end)) if *end == frame => *end += 1,
            _ => spans.push((frame, frame + 1)),
        }
    }
    let rect = |(start, end): (usize, usize)| {
        let (x, width) = (start as f64 * step, ((end - start) as f64 * step).max(1.0));
        view! { <rect class="gap" x=format!("{x:.1}") y="0" width=format!("{width:.1}") height=height.to_string() /> }
    };
    spans.into_iter().map(rect).collect_view()
}

/// The paths of all things that move in the same space: from above, and from the side.
fn planes(recording: &Recording) -> impl IntoView + use<> {
    let spatial = recording.subsets.iter().find(|subset| subset.axes.len() >= 2);
    let Some(RecordedSubset { axes, .. }) = spatial else {
        return view! { <p class="hint">"No subset has two features to draw against each other."</p> }
            .into_any();
    };
    let second = if axes.len() > 2 { vec![1, 2] } else { vec![1] };
    let plane = |up: usize| {
        let alike = recording.subsets.iter().filter(|subset| subset.axes == *axes);
        let traces: Vec<Trace> = alike.map(|subset| trace(&recording.track, (0, up), subset)).collect();
        plane_view((&axes[0], &axes[up]), &traces)
    };
    second.into_iter().map(plane).collect_view().into_any()
}

fn trace(track: &Track, (across, up): (usize, usize), subset: &RecordedSubset) -> Trace {
    let columns = subset.columns.get(across).zip(subset.columns.get(up));
    let pairs = columns.map(|(&x, &y)| track.column(x).zip(track.column(y)));
    let points = pairs.into_iter().flatten().map(|(x, y)| Some((f64::from(x?), f64::from(y?)))).collect();
    Trace { name: subset.name.clone(), class: subset.class.clone(), points }
}
