//! The Demonstrations tab: files, the recording of one demonstration, settings.

use leptos::prelude::*;

use super::{files, settings, tracks};
use crate::page::update::App;

/// List, canvas and inspector.
pub(crate) fn demonstrations(app: App) -> impl IntoView {
    view! {
        <div class="columns">
            {files::files(app)}
            <section class="canvas scroll" tabindex="0" aria-label="Recording">{tracks::tracks(app)}</section>
            {settings::settings(app)}
        </div>
    }
}
