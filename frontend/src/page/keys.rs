//! Keys to commands.

use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, KeyboardEvent};

use super::commands::commands;
use super::update::App;

/// Does the command that the pressed key stands for.
pub(crate) fn press(app: App, event: &KeyboardEvent) {
    // A dialog and a text field have the keyboard for themselves.
    if app.model.overlay.get_untracked().is_some() || event.default_prevented() {
        return;
    }
    let command_key = event.ctrl_key() || event.meta_key();
    if is_typing(event) && (!command_key || EDITS_TEXT.contains(&event.key().to_lowercase().as_str())) {
        return;
    }
    let key = name_of(&event.key(), &event.code(), command_key, event.shift_key());
    // With Shift a letter is the same command, unless it has one of its own.
    let without_shift = key.replace("Ctrl+Shift+", "Ctrl+");
    let named = |key: &str| commands().find(|command| command.keys.contains(&key));
    let Some(command) = named(&key).or_else(|| named(&without_shift)) else { return };
    let enabled = untrack(|| (command.enabled)(app));
    // A focused button answers to Enter and the space bar by itself.
    if ["Enter", " "].contains(&key.as_str()) && (!enabled || is_button(event)) {
        return;
    }
    if enabled {
        event.prevent_default();
        (command.run)(app);
    }
}

/// What these keys do with Ctrl in a text field is the field's business.
const EDITS_TEXT: [&str; 7] = ["a", "z", "y", "delete", "backspace", "arrowleft", "arrowright"];

/// How a key is written in the command table: `o`, `Shift+1`, `Ctrl+k`, `?`.
pub(crate) fn name_of(key: &str, code: &str, command_key: bool, shift: bool) -> String {
    let control = if command_key { "Ctrl+" } else { "" };
    // With Shift, a digit key writes what the keyboard's language has there.
    match code.strip_prefix("Digit") {
        Some(digit) if shift && key != "+" && key != "?" && key != "-" => format!("{control}Shift+{digit}"),
        _ if key.chars().count() == 1 && command_key && shift => format!("Ctrl+Shift+{}", key.to_lowercase()),
        _ if key.chars().count() == 1 => format!("{control}{}", key.to_lowercase()),
        _ => format!("{control}{key}"),
    }
}

/// How a key is written for people: `Ctrl+K`.
pub(crate) fn shown(key: &str) -> String {
    match key.rsplit_once('+') {
        Some((modifier, letter)) if letter.chars().count() == 1 => {
            format!("{modifier}+{}", letter.to_uppercase())
        }
        _ if key.len() == 1 && key != " " => key.to_uppercase(),
        _ => key.replace("Escape", "Esc").replace(' ', "Space"),
    }
}

fn is_button(event: &KeyboardEvent) -> bool {
    let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    target.is_some_and(|element| {
        let kind = element.get_attribute("type").unwrap_or_default();
        let switch = element.tag_name() == "INPUT" && ["checkbox", "radio"].contains(&kind.as_str());
        switch || ["BUTTON", "SUMMARY", "A"].contains(&element.tag_name().as_str())
    })
}

fn is_typing(event: &KeyboardEvent) -> bool {
    let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    target.is_some_and(|element| {
        let kind = element.get_attribute("type").unwrap_or_default();
        let text_input =
            element.tag_name() == "INPUT" && !["checkbox", "radio", "file", "range"].contains(&kind.as_str());
        text_input || ["TEXTAREA", "SELECT"].contains(&element.tag_name().as_str())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_named_as_the_table_writes_them() {
        assert_eq!(name_of("o", "KeyO", false, false), "o");
        assert_eq!(name_of("k", "KeyK", true, false), "Ctrl+k");
        assert_eq!(name_of("Z", "KeyZ", true, true), "Ctrl+Shift+z");
        assert_eq!(name_of("Delete", "Delete", true, false), "Ctrl+Delete");
        assert_eq!(name_of("!", "Digit1", false, true), "Shift+1");
        assert_eq!(name_of("?", "Slash", false, true), "?");
        assert_eq!(name_of("?", "Minus", false, true), "?");
        assert_eq!(name_of("+", "Digit1", false, true), "+");
        assert_eq!(name_of("Escape", "Escape", false, false), "Escape");
    }

    #[test]
    fn keys_are_shown_as_people_write_them() {
        assert_eq!(
            ["Ctrl+k", "o", "Shift+1", "+", "Escape", "Ctrl+Delete", " "].map(shown),
            ["Ctrl+K", "O", "Shift+1", "+", "Esc", "Ctrl+Delete", "Space"]
        );
    }
}
