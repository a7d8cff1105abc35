//! The name under which somebody saves and signs, remembered by the browser.

const KEY: &str = "goalgraph.author";

/// The name of the last visit.
pub(crate) fn stored() -> String {
    let storage = leptos::prelude::window().local_storage().ok().flatten();
    storage.and_then(|storage| storage.get_item(KEY).ok().flatten()).unwrap_or_default()
}

/// Remembers a name. Without storage it lasts as long as the page.
pub(crate) fn store(name: &str) {
    if let Ok(Some(storage)) = leptos::prelude::window().local_storage() {
        let _ = storage.set_item(KEY, name);
    }
}
