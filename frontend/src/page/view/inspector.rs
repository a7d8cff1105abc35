//! What is selected in the automaton: the evidence behind every number, and every way to change it.

mod automaton;
mod evidence;
mod interval;
mod name;
mod several;
mod state;
mod sub_goal;
mod transition;
mod weights;

use leptos::prelude::*;

use crate::page::model::Selection;
use crate::page::update::App;

pub(crate) use sub_goal::sub_goal_editor;

/// The column at the right of the Automaton tab.
pub(crate) fn inspector(app: App) -> impl IntoView {
    // The inspector of one thing stays while that thing is changed, so that the focus stays where it was.
    let selection = Memo::new(move |_| app.model.selection.get());
    view! {
        <aside class="inspector" aria-label="Inspector">
            {move || match *selection.get() {
                [] => automaton::automaton(app).into_any(),
                [Selection::State(id)] => state::state(app, id).into_any(),
                [Selection::Transition(source, symbol)] => transition::transition(app, source, symbol).into_any(),
                ref several => several::several(app, several).into_any(),
            }}
        </aside>
    }
}

/// One line of a list of facts.
pub(crate) fn fact(name: &'static str, value: impl IntoView) -> impl IntoView {
    view! { <div><dt>{name}</dt><dd>{value}</dd></div> }
}

/// One line of a list of facts, with what it means.
pub(crate) fn fact_with_help(name: &'static str, help: &'static str, value: impl IntoView) -> impl IntoView {
    view! { <div title=help><dt>{name}</dt><dd>{value}</dd></div> }
}
