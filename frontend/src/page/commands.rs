//! Everything that a person can do, in one table: buttons, keys, menus, the palette and the help page are made of it.

mod drawing;
mod editing;
mod files;
mod going;
mod keeping;
mod running;

use leptos::prelude::*;

use super::update::App;

pub(crate) use files::FILE_INPUT;
pub(crate) use keeping::{is_kept, may_approve};

/// What a person can do.
pub(crate) struct Command {
    /// Its name in the program.
    pub(crate) id: &'static str,
    /// What is on its button.
    pub(crate) label: &'static str,
    /// What it does, as a sentence.
    pub(crate) help: &'static str,
    /// The keys that do it, as [`super::keys::name_of`] writes keys.
    pub(crate) keys: &'static [&'static str],
    /// Whether it is in the menu at the pointer, for what is selected there.
    pub(crate) in_menu: bool,
    /// Whether it can be done now.
    pub(crate) enabled: fn(App) -> bool,
    /// Does it.
    pub(crate) run: fn(App),
}

/// The table in its parts, each with what it is about, in the order of the help page.
pub(crate) const GROUPS: [(&str, &[Command]); 6] = [
    ("Files", files::COMMANDS),
    ("Server", keeping::COMMANDS),
    ("Editing", editing::COMMANDS),
    ("Drawing", drawing::COMMANDS),
    ("Running", running::COMMANDS),
    ("Going around", going::COMMANDS),
];

/// All commands.
pub(crate) fn commands() -> impl Iterator<Item = &'static Command> {
    GROUPS.iter().flat_map(|(_, commands)| commands.iter())
}

/// The command called `id`.
pub(crate) fn command(id: &str) -> Option<&'static Command> {
    commands().find(|command| command.id == id)
}

fn always(_: App) -> bool {
    true
}

fn has_automaton(app: App) -> bool {
    app.derived.specification.with(Option::is_some)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn no_two_commands_have_one_key() {
        let keys: Vec<&str> = commands().flat_map(|command| command.keys).copied().collect();
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len(), "{keys:?}");
    }

    #[test]
    fn no_two_commands_have_one_id_or_label() {
        let ids: BTreeSet<&str> = commands().map(|command| command.id).collect();
        let labels: BTreeSet<&str> = commands().map(|command| command.label).collect();
        assert_eq!((ids.len(), labels.len()), (commands().count(), commands().count()));
    }

    #[test]
    fn every_command_says_what_it_does_in_a_sentence() {
        assert!(commands().all(|command| command.help.ends_with('.')));
    }
}
