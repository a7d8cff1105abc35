//! The files with their verdicts, and the demonstrations in them.

use std::sync::Arc;

use leptos::prelude::*;

use super::chips::{button, short_button};
use crate::page::model::LoadedFile;
use crate::page::text::{bytes, count, grouped};
use crate::page::update::{Action, App};
use crate::page::verdict::Verdict;
use crate::protocol::{DemonstrationId, FileContent, FileId};

/// The list at the left of the Demonstrations tab.
pub(crate) fn files(app: App) -> impl IntoView {
    let each = move || app.model.files.get();
    view! {
        <section class="list" aria-label="Files">
            <header class="section-head">
                <h2>"Files"</h2>
                <span class="hint">{move || summary(app)}</span>
            </header>
            <div class="row">{short_button(app, "open", "Open")} {button(app, "clear")}</div>
            <ul class="files">
                <For each key=|file| file.id children=move |file| row(app, &file) />
            </ul>
        </section>
    }
}

/// How many demonstrations take part, and how many files do not.
fn summary(app: App) -> String {
    let accepted = app.derived.accepted.get();
    let demonstrations = accepted.iter().map(|(_, content)| content.demonstrations.len()).sum();
    let is_refused = |(_, verdict): &&(FileId, Verdict)| matches!(verdict, Verdict::Refused(_));
    let refused = app.derived.verdicts.with(|verdicts| verdicts.iter().filter(is_refused).count());
    let refused = if refused > 0 { format!(", {refused} refused") } else { String::new() };
    format!("{}{refused}", count(demonstrations, "demonstration"))
}

fn row(app: App, file: &LoadedFile) -> impl IntoView + use<> {
    let id = file.id;
    let verdict = Memo::new(move |_| {
        let of_file =
            |verdicts: &Vec<(FileId, Verdict)>| verdicts.iter().find(|(file, _)| *file == id).cloned();
        app.derived.verdicts.with(of_file).map_or(Verdict::Reading, |(_, verdict)| verdict)
    });
    let name = file.name.clone();
    let file_name = name.clone();
    let size = bytes(file.bytes);
    view! {
        <li class="file" data-file=name.clone() data-verdict=move || word(&verdict.get())>
            <div class="file-head">
                <span class=move || format!("verdict {}", word(&verdict.get())) aria-hidden="true"></span>
                <span class="file-name" title=name.clone()>{name.clone()}</span>
                <span class="hint size">{size}</span>
                <button
                    type="button"
                    class="icon-button small"
                    aria-label=format!("Remove {name}")
                    on:click=move |_| app.act(Action::Remove(id))
                >
                    <span aria-hidden="true">"×"</span>
                </button>
            </div>
            {move || details(app, id, &file_name, verdict.get())}
        </li>
    }
}

/// One word for the verdict, also the name of its color.
fn word(verdict: &Verdict) -> &'static str {
    match verdict {
        Verdict::Reading => "reading",
        Verdict::Canceled => "canceled",
        Verdict::Accepted(_) => "accepted",
        Verdict::Refused(_) => "refused",
    }
}

fn details(app: App, id: FileId, name: &str, verdict: Verdict) -> AnyView {
    match verdict {
        Verdict::Reading => view! { <p class="file-note">"Reading"</p> }.into_any(),
        Verdict::Refused(reason) => view! { <p class="file-note refused">"Refused: " {reason}</p> }.into_any(),
        Verdict::Canceled => view! {
            <p class="file-note">
                "Canceled before it was read. "
                <button type="button" class="link" on:click=move |_| app.act(Action::ReadAgain(id))>"Read again"</button>
            </p>
        }
        .into_any(),
        Verdict::Accepted(content) if content.demonstrations.len() == 1 => single(app, id, &content).into_any(),
        Verdict::Accepted(content) => accepted(app, id, name, &content).into_any(),
    }
}

/// A file with one demonstration is that demonstration.
fn single(app: App, file: FileId, content: &Arc<FileContent>) -> impl IntoView + use<> {
    let id = DemonstrationId { file, index: 0 };
    let shown = move || app.model.demonstration.get() == Some(id);
    let entry = content.demonstrations.first();
    let (frames, undefined) = entry.map_or((0, 0), |entry| (entry.frames, entry.undefined));
    let features = content.features.len();
    let label = entry.map(|entry| format!("Show {}", entry.name));
    view! {
        <button
            type="button"
            class="entry single"
            aria-label=label
            aria-pressed=move || shown().to_string()
            on:click=move |_| app.act(Action::Show(id))
        >
            <span>{count(frames, "frame")} <span class="optional">", " {count(features, "feature")}</span></span>
            {missing(undefined, frames * features).map(|text| view! { <span class="tag">{text}</span> })}
        </button>
    }
}

fn accepted(app: App, file: FileId, name: &str, content: &Arc<FileContent>) -> impl IntoView + use<> {
    let frames = content.demonstrations.iter().map(|demonstration| demonstration.frames).sum();
    let parts = [
        count(content.demonstrations.len(), "demonstration"),
        count(frames, "frame"),
        count(content.features.len(), "feature"),
    ];
    let limit = RwSignal::new(PORTION);
    let (whole, content, name) = (content.demonstrations.len(), Arc::clone(content), name.to_owned());
    let entry = move |index: usize| entry(app, DemonstrationId { file, index }, &name, &content);
    view! {
        <p class="file-note">{parts.join(", ")}</p>
        <ul class="demonstrations">
            <For each=move || 0..limit.get().min(whole) key=|index| *index children=entry />
            {move || (limit.get() < whole).then(|| view! {
                <li>
                    <button type="button" class="entry link" on:click=move |_| limit.update(|limit| *limit += PORTION)>
                        {format!("Show more of {}", grouped(whole))}
                    </button>
                </li>
            })}
        </ul>
    }
}

/// How many demonstrations of a file are listed at a time: a file may have thousands.
const PORTION: usize = 200;

fn entry(app: App, id: DemonstrationId, file_name: &str, content: &FileContent) -> impl IntoView + use<> {
    let entry = content.demonstrations.get(id.index)?;
    // Below the file's name, only what tells a demonstration from the others is worth reading.
    let name = entry.name.strip_prefix(file_name).map_or(entry.name.as_str(), str::trim);
    let missing = missing(entry.undefined, entry.frames * content.features.len());
    Some(demonstration(app, id, name, missing, entry.frames))
}

fn demonstration(
    app: App,
    id: DemonstrationId,
    name: &str,
    missing: Option<String>,
    frames: usize,
) -> impl IntoView + use<> {
    let shown = move || app.model.demonstration.get() == Some(id);
    view! {
        <li>
            <button
                type="button"
                class="entry"
                aria-pressed=move || shown().to_string()
                on:click=move |_| app.act(Action::Show(id))
            >
                <span class="entry-name">{name.to_owned()}</span>
                {missing.map(|text| view! { <span class="tag">{text}</span> })}
                <span class="hint">{count(frames, "frame")}</span>
            </button>
        </li>
    }
}

/// How much of a recording was not observed; none when all of it was.
fn missing(undefined: usize, values: usize) -> Option<String> {
    let share = 100.0 * undefined as f64 / values.max(1) as f64;
    match share {
        share if share <= 0.0 => None,
        share if share < 1.0 => Some("<1% missing".to_owned()),
        share => Some(format!("{share:.0}% missing")),
    }
}
