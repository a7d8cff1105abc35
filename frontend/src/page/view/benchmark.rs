//! The benchmark page: what an edit costs against the number of states.

use leptos::prelude::*;

use crate::page::benchmark::{SUB_GOALS, Timing, measure};
use crate::page::text::grouped;

/// A table that fills row by row.
pub(crate) fn benchmark() -> impl IntoView {
    let timings = RwSignal::new(Vec::<Timing>::new());
    let running = RwSignal::new(false);
    let run = move |_| {
        running.set(true);
        timings.set(Vec::new());
        next(timings, running, 0);
    };
    let cell = |time: f64, unit: f64| {
        view! { <td class="number">{format!("{time:.1} ms")} <span class="hint">{format!("{:.1}×", time / unit.max(0.05))}</span></td> }
    };
    let row = move |timing: Timing| {
        let unit = timing.write;
        view! {
            <tr data-states=timing.states.to_string()>
                <th scope="row">{grouped(timing.states)}</th>
                <td class="number">{grouped(timing.transitions)}</td>
                <td class="number">{format!("{unit:.1} ms")}</td>
                {cell(timing.preview_merge, unit)}
                {cell(timing.preview_prune, unit)}
                {cell(timing.distance, unit)}
                {cell(timing.layout, unit)}
                {cell(timing.adjust, unit)}
            </tr>
        }
    };
    view! {
        <h2>"Speed of an edit"</h2>
        <p class="hint">"Automata of 4, 8 and 12 sub-goals in any order, measured in this browser. Beside each time is its ratio to writing the specification as JSON in the same run: touching all of it once."</p>
        <div class="row"><button type="button" class="button primary" disabled=move || running.get() on:click=run>"Measure"</button></div>
        <table class="benchmark">
            <thead><tr>
                <th scope="col">"States"</th><th scope="col">"Transitions"</th><th scope="col">"Write as JSON"</th>
                <th scope="col">"Preview a merge"</th><th scope="col">"Preview a prune"</th>
                <th scope="col">"Distance"</th><th scope="col">"Layout"</th><th scope="col">"Move one state"</th>
            </tr></thead>
            <tbody>{move || timings.get().into_iter().map(row).collect_view()}</tbody>
        </table>
    }
}

/// Measures one automaton after the other; between them the page shows what is there.
fn next(timings: RwSignal<Vec<Timing>>, running: RwSignal<bool>, at: usize) {
    let Some(&sub_goals) = SUB_GOALS.get(at) else { return running.set(false) };
    set_timeout(
        move || {
            let timing = measure(sub_goals);
            timings.update(|timings| timings.push(timing));
            next(timings, running, at + 1);
        },
        std::time::Duration::from_millis(30),
    );
}
