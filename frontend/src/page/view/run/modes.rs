//! The switch between trying and watching, and how the line to the server is.

use leptos::prelude::*;

use crate::page::clock;
use crate::page::commands::command;
use crate::page::model::{Connection, RunMode, Server};
use crate::page::update::App;

/// The switch.
pub(super) fn modes(app: App) -> impl IntoView {
    let running = move || {
        app.model.watching.heard.with(|heard| heard.runs.iter().filter(|run| !run.phase.is_over()).count())
    };
    let badge = move || {
        let number = running();
        (number > 0).then(|| {
            let title = if number == 1 { "1 run".to_owned() } else { format!("{number} runs") };
            view! { <span class="badge running" title=title>{number}</span> }
        })
    };
    view! {
        <div class="modes" role="group" aria-label="What the Run tab shows">
            {mode(app, RunMode::Monitor, "monitor", "Monitoring", badge.into_any())}
            {mode(app, RunMode::Simulate, "try-out", "Simulation", ().into_any())}
        </div>
    }
}

fn mode(app: App, mode: RunMode, id: &'static str, name: &'static str, badge: AnyView) -> impl IntoView {
    let pressed = move || app.derived.watched.mode.get() == mode;
    command(id).map(|command| {
        view! {
            <button
                type="button"
                class="mode"
                title=command.help
                aria-pressed=move || pressed().to_string()
                on:click=move |_| (command.run)(app)
            >
                {name} {badge}
            </button>
        }
    })
}

/// How the line to the server is.
pub(super) fn connection(app: App) -> impl IntoView {
    let locked = move || app.model.keeping.server.with(|server| *server == Server::Locked);
    let absent = move || app.model.keeping.server.with(|server| *server == Server::Absent);
    let text = move || match app.model.watching.connection.get() {
        _ if locked() => ("locked", "The server asks for a token: log in to watch".to_owned()),
        _ if absent() => ("none", "No server: no robot can be watched here".to_owned()),
        Connection::Connecting => ("connecting", "Connecting to the server".to_owned()),
        Connection::Live => ("live", "Live".to_owned()),
        Connection::Lost { since_ms } => {
            ("lost", format!("Reconnecting since {}: this is from before", clock::of_ms(since_ms)))
        }
        Connection::NoServer => ("none", "The server does not answer".to_owned()),
    };
    view! {
        <p class="connection" role="status" data-connection=move || text().0>
            <span class="lamp" aria-hidden="true"></span>
            <span>{move || text().1}</span>
        </p>
    }
}
