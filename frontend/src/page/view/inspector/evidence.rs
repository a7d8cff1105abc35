//! The demonstrations behind a number, and the frames where they completed the sub-goal.

use std::sync::Arc;

use goalgraph::specification::Specification;
use leptos::prelude::*;

use crate::page::text::{count, grouped};
use crate::page::update::{Action, App};

/// How many demonstrations are listed at most.
const LISTED: usize = 100;

/// A demonstration that passes, and the symbol of its word that it completes then.
pub(super) struct Pass {
    /// Which demonstration.
    pub(super) demonstration: usize,
    /// The position of the symbol; none at the start, where nothing is completed yet.
    pub(super) symbol: Option<usize>,
}

/// Who passed, and when.
pub(super) fn passages(
    app: App,
    specification: &Arc<Specification>,
    passages: &[Pass],
) -> impl IntoView + use<> {
    let heading = count(passages.len(), "demonstration");
    let more = passages.len().saturating_sub(LISTED);
    let more = (more > 0).then(|| view! { <li>{format!("and {} more", grouped(more))}</li> });
    let items: Vec<_> =
        passages.iter().take(LISTED).filter_map(|it| passage(app, specification, it)).collect();
    view! { <h3>{heading} " pass here"</h3><ul class="evidence-list">{items}{more}</ul> }
}

fn passage(app: App, specification: &Specification, passage: &Pass) -> Option<impl IntoView + use<>> {
    let demonstration = specification.demonstrations.get(passage.demonstration)?;
    let (name, frames) = (demonstration.name.clone(), demonstration.frames);
    let symbol = passage.symbol.and_then(|position| demonstration.word.get(position));
    let frame = symbol.and_then(|&symbol| app.completed_in(passage.demonstration, symbol));
    let when = frame.map(|frame| {
        let share = 100.0 * frame as f64 / frames.max(1) as f64;
        view! {
            <span class="when" title=format!("frame {frame} of {frames}")>
                <svg width="60" height="8" viewBox="0 0 100 8" preserveAspectRatio="none" aria-hidden="true">
                    <rect class="band-scale" x="0" y="3" width="100" height="2" />
                    <rect class="band-mark" x=format!("{:.1}", share.min(97.0)) y="0" width="4" height="8" />
                </svg>
                {format!("frame {frame}")}
            </span>
        }
    });
    let index = passage.demonstration;
    let show = move |_| app.act(Action::ShowNamed(index, frame));
    Some(view! {
        <li>
            <button type="button" class="entry" title="Show the demonstration" on:click=show>
                <span class="entry-name">{name}</span> {when}
            </button>
        </li>
    })
}
