//! What differs, in words.

use std::sync::Arc;

use goalgraph::difference::{Change, Part};
use goalgraph::language::WordSet;
use goalgraph::layout::drawing::probability_text;
use goalgraph::pdfa::Word;
use goalgraph::specification::SubGoal;
use leptos::prelude::*;
use web_sys::{ScrollIntoViewOptions, ScrollLogicalPosition};

use crate::page::derived::{Drawing, Sign, state_words};
use crate::page::text::count;
use crate::page::update::{Action, App, KeepAction};

/// The list of changes; each goes to its place in the drawing.
pub(super) fn changes(app: App, drawing: &Arc<Drawing>) -> impl IntoView + use<> {
    let difference = &drawing.difference;
    let union = &difference.union;
    let mut rows: Vec<AnyView> = Vec::new();
    for sentence in general(drawing) {
        rows.push(
            view! { <li class="change changed"><p><span class="sign">"~"</span> {sentence}</p></li> }
                .into_any(),
        );
    }
    for change in difference.sub_goals.values() {
        rows.push(plain(Sign::of(change), sub_goal(change)));
    }
    for (id, change) in &difference.states {
        let words = state_words(change);
        let text = if words.is_empty() { format!("State {id}") } else { format!("State {id}: {words}") };
        rows.push(row(app, Sign::of(change), text, id.to_string()).into_any());
    }
    for (&(source, symbol), change) in &difference.transitions {
        let (name, chance) = drawing.label(source, symbol);
        let side = change.after.as_ref().or(change.before.as_ref());
        let target = side.map(|side| side.target.to_string()).unwrap_or_default();
        let name = if name.is_empty() { union.name_of(symbol) } else { name };
        let text = format!("{name}, {source} to {target}: {chance}");
        rows.push(row(app, Sign::of(change), text, format!("{source} {symbol}")).into_any());
    }
    let empty = rows.is_empty().then(|| view! { <p class="hint">"Nothing differs."</p> });
    view! { <div class="changes"><h3>"Changes"</h3> {empty} <ul aria-label="Changes">{rows}</ul></div> }
}

fn row(app: App, sign: Sign, text: String, part: String) -> impl IntoView {
    let show = move |_| {
        app.act(Action::Keep(KeepAction::Point(Some(part.clone()))));
        if let Ok(Some(element)) = document().query_selector(&format!("[data-part=\"{part}\"]")) {
            // Only as far as needed: the dialog around the drawing stays where it is.
            let options = ScrollIntoViewOptions::new();
            options.set_block(ScrollLogicalPosition::Nearest);
            options.set_inline(ScrollLogicalPosition::Nearest);
            element.scroll_into_view_with_scroll_into_view_options(&options);
        }
    };
    view! {
        <li class=format!("change {}", sign.class())>
            <button type="button" class="entry" on:click=show>
                <span class="sign" aria-hidden="true">{sign.sign()}</span>
                <span class="visually-hidden">{format!("{}: ", sign.word())}</span>
                <span class="change-text">{text}</span>
            </button>
        </li>
    }
}

fn plain(sign: Sign, text: String) -> AnyView {
    view! {
        <li class=format!("change {}", sign.class())>
            <p>
                <span class="sign" aria-hidden="true">{sign.sign()}</span>
                <span class="visually-hidden">{format!("{}: ", sign.word())}</span>
                <span class="change-text">{text}</span>
            </p>
        </li>
    }
    .into_any()
}

/// What differs of the whole.
fn general(drawing: &Drawing) -> Vec<String> {
    let difference = &drawing.difference;
    let mut sentences = Vec::new();
    if let Some(Change { before: Some(old), after: Some(new) }) = &difference.name {
        sentences.push(format!("Task name: {old} → {new}"));
    }
    if difference.semantics.is_some() {
        sentences.push("Weights are read in another way".to_owned());
    }
    for part in &difference.parts {
        sentences.push(match part {
            Part::Features => "Other features".to_owned(),
            Part::Subsets => "Other feature subsets, or other parameters of them".to_owned(),
        });
    }
    let gone = difference.demonstrations.iter().filter(|it| it.after.is_none()).count();
    let new = difference.demonstrations.len() - gone;
    if gone + new > 0 {
        sentences.push(format!("Evidence: {} new, {gone} no more", count(new, "demonstration")));
    }
    sentences
}

fn sub_goal(change: &Change<SubGoal>) -> String {
    match (&change.before, &change.after) {
        (Some(old), Some(new)) => {
            let mut words = Vec::new();
            if old.name != new.name {
                words.push(format!("{} → {}", old.name, new.name));
            }
            if old.ball != new.ball {
                words.push("its ball moved".to_owned());
            }
            if old.color != new.color {
                words.push("another color".to_owned());
            }
            if (old.frames, old.demonstrations) != (new.frames, new.demonstrations) {
                words.push("other evidence".to_owned());
            }
            format!("Sub-goal {}: {}", new.name, words.join(", "))
        }
        (Some(it), None) | (None, Some(it)) => format!("Sub-goal {}", it.name),
        (None, None) => String::new(),
    }
}

/// The words that are gained and lost, with their probabilities.
pub(super) fn words(drawing: &Arc<Drawing>) -> impl IntoView + use<> {
    let difference = &drawing.difference;
    let variation = difference.distance.total_variation;
    let variation = if (variation.high - variation.low).abs() < 1e-9 {
        probability_text(variation.high)
    } else {
        format!("{} to {}", probability_text(variation.low), probability_text(variation.high))
    };
    view! {
        <div class="consequence">
            {word_set(drawing, "Newly accepted", "gained", "+", &difference.effect.gained)}
            {word_set(drawing, "No longer accepted", "lost", "\u{2212}", &difference.effect.lost)}
            <p class="hint variation">
                {format!("Total variation of the words' probabilities: {variation} (0 is the same, 1 is entirely different).")}
            </p>
        </div>
    }
}

fn word_set(
    drawing: &Drawing,
    heading: &'static str,
    class: &'static str,
    sign: &'static str,
    set: &WordSet,
) -> impl IntoView + use<> {
    let number = match set.number {
        Some(0) => return view! { <p class="hint">{format!("{heading}: no word")}</p> }.into_any(),
        Some(number) => count(usize::try_from(number).unwrap_or(usize::MAX), "word"),
        None => "infinitely many words".to_owned(),
    };
    let row = |(word, probability): &(Word, f64)| {
        let chips = word.iter().map(|symbol| {
            let color = drawing.colors.get(symbol).map(|color| color.class()).unwrap_or_default();
            view! { <li><span class=format!("chip {color}")>{drawing.difference.union.name_of(*symbol)}</span></li> }
        });
        view! {
            <li>
                <ol class="word">{chips.collect_view()}</ol>
                <span class="hint">{probability_text(*probability)}</span>
            </li>
        }
    };
    let mass = format!("probability {}", probability_text(set.mass));
    view! {
        <div class=format!("language {class}")>
            <h3>{format!("{sign} {heading}: {number} ")} <span class="hint">{mass}</span></h3>
            <ul class="examples">{set.examples.iter().map(row).collect_view()}</ul>
        </div>
    }
    .into_any()
}
