//! How a run fares against the automaton, and what can come of it.

use leptos::prelude::*;

use crate::page::clock;
use crate::page::run_text::{departed, surprise};
use crate::page::text::significant;
use crate::page::update::{Action, App, WatchAction};
use crate::page::view::chips::button;

/// Likelihood, departure, and the way to make the run a demonstration.
pub(super) fn verdict(app: App) -> impl IntoView {
    let shown = app.derived.watched.shown;
    let facts = move || {
        shown.get().map(|run| {
            view! {
                <dl class="facts">
                    <div><dt>"Began"</dt><dd>{clock::of(&run.began_at)}</dd></div>
                    <div><dt>"Last heard"</dt><dd>{clock::of(&run.heard_at)}</dd></div>
                    <div title="Natural logarithm of the probability of the transitions taken.">
                        <dt>"Log-likelihood"</dt><dd>{significant(run.log_likelihood)}</dd>
                    </div>
                    <div title="The less probable the transitions were, the larger it is.">
                        <dt>"Surprise"</dt><dd>{surprise(run.log_likelihood)}</dd>
                    </div>
                    <div><dt>"New plans"</dt><dd>{run.replans}</dd></div>
                </dl>
            }
        })
    };
    view! {
        {move || shown.with(Option::is_some).then(|| view! { <h2>"Run"</h2> })}
        {facts}
        {move || departure(app)}
    }
}

fn departure(app: App) -> Option<impl IntoView> {
    let departure = app.derived.watched.shown.with(|run| run.as_ref().and_then(|run| run.departure))?;
    let followed = app.derived.watched.followed.get();
    let sentence = departed(followed.as_ref().map(|it| &*it.specification), &departure);
    let number = match departure {
        goalgraph::run::Departure::NoWay { number, .. }
        | goalgraph::run::Departure::EndedEarly { number, .. } => number,
    };
    let go = move |_| app.act(Action::Watch(WatchAction::Replay(Some(number))));
    let refusal = move || {
        app.promotion_refusal()
            .map(|reason| view! { <p class="hint">{format!("Cannot be promoted: {reason}.")}</p> })
    };
    Some(view! {
        <section class="departure" aria-label="Left the automaton">
            <h3>"Left the automaton"</h3>
            <p>{sentence} ". " <button type="button" class="link" on:click=go>{format!("Event {number}")}</button></p>
            {button(app, "promote")}
            {refusal}
        </section>
    })
}
