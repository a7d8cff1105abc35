//! What is wrong, each one click from its place, and from its fix where there is one.

use goalgraph::fix::fix;
use goalgraph::specification::{Place, Problem, Severity};
use leptos::prelude::*;

use crate::page::model::{Selection, Tab};
use crate::page::text::grouped;
use crate::page::update::{Action, App};
use crate::page::view::chips::edit_button;
use crate::page::view::graph;

/// How many problems are listed at most; the errors come first.
const LISTED: usize = 100;

/// The list of problems.
pub(super) fn problems(app: App) -> impl IntoView {
    let none = move || app.derived.problems.with(Vec::is_empty);
    let more = move || app.derived.problems.with(Vec::len).checked_sub(LISTED).filter(|more| *more > 0);
    view! {
        {move || none().then(|| view! { <p class="fits">"Nothing is wrong."</p> })}
        <ul class="problem-list">
            <For
                each=move || app.derived.problems.with(|problems| problems[..problems.len().min(LISTED)].to_vec())
                key=|problem| format!("{:?} {}", problem.kind, problem.message)
                children=move |problem| row(app, &problem)
            />
        </ul>
        {move || more().map(|more| view! { <p class="hint">{format!("and {} more", grouped(more))}</p> })}
    }
}

fn row(app: App, problem: &Problem) -> impl IntoView + use<> {
    let place = problem.place();
    let error = problem.severity == Severity::Error;
    let problem_now = problem.clone();
    let fixed = move || {
        let fixed =
            app.derived.specification.with_untracked(|it| fix(it.as_ref()?, &problem_now, app.next_state()));
        fixed.map(|transaction| transaction.edits).unwrap_or_default()
    };
    let fix_button = (!fixed().is_empty()).then(|| edit_button(app, "Fix", fixed));
    view! {
        <li class="problem" class:error=error>
            <span class="problem-kind">{if error { "Error" } else { "Warning" }}</span>
            <p>{problem.message.clone()}</p>
            <div class="row">
                <button type="button" class="button" on:click=move |_| go(app, &place)>"Show"</button>
                {fix_button}
            </div>
        </li>
    }
}

/// Goes to where a problem is.
fn go(app: App, place: &Place) {
    let item = match *place {
        Place::State(id) => Selection::State(id),
        Place::Transition(source, symbol, _) => Selection::Transition(source, symbol),
        Place::SubGoal(_) => return app.act(Action::GoTo(Tab::SubGoals)),
    };
    app.act(Action::Select(Some(item)));
    graph::show(app, &[item]);
}
