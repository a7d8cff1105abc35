//! Light or dark: as the system has it, until somebody chooses.

/// The colors of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Theme {
    /// As the system.
    #[default]
    System,
    /// Dark on light.
    Light,
    /// Light on dark.
    Dark,
}

const KEY: &str = "goalgraph.theme";

impl Theme {
    /// What was chosen in this browser before.
    pub(crate) fn stored() -> Self {
        let stored = storage().and_then(|storage| storage.get_item(KEY).ok().flatten());
        match stored.as_deref() {
            Some("light") => Self::Light,
            Some("dark") => Self::Dark,
            _ => Self::System,
        }
    }

    /// The other one than the one on display.
    pub(crate) fn toggled(self) -> Self {
        match self {
            Self::Dark => Self::Light,
            Self::System if system_is_dark() => Self::Light,
            Self::Light | Self::System => Self::Dark,
        }
    }

    /// Shows it, and remembers it for the next visit.
    pub(crate) fn apply(self) {
        let name = match self {
            Self::System => return,
            Self::Light => "light",
            Self::Dark => "dark",
        };
        // Without storage the choice lasts as long as the page.
        if let Some(storage) = storage() {
            let _ = storage.set_item(KEY, name);
        }
        if let Some(root) = leptos::prelude::document().document_element() {
            let _ = root.set_attribute("data-theme", name);
        }
    }
}

fn storage() -> Option<web_sys::Storage> {
    leptos::prelude::window().local_storage().ok().flatten()
}

fn system_is_dark() -> bool {
    let query = leptos::prelude::window().match_media("(prefers-color-scheme: dark)");
    query.ok().flatten().is_some_and(|query| query.matches())
}
