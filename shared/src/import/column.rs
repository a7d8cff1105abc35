//! What the columns of a file are for, by their names.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::text::quoted;
use crate::demonstration::Feature;

/// More columns than this are taken for a mistake: lines were meant.
pub(super) const MAX_COLUMNS: usize = 100_000;
/// Columns that say which demonstration a frame belongs to.
const DEMONSTRATION: [&str; 7] =
    ["demo", "demonstration", "episode", "episode_index", "episode_id", "trial", "run_id"];
/// Columns of time, which must not run backwards; also with a unit suffix such as `_ms`.
const TIME: [&str; 4] = ["t", "time", "timestamp", "stamp"];
/// Columns that count or are parts of a time stamp.
const COUNTER: [&str; 9] =
    ["sec", "secs", "nsec", "nsecs", "frame", "frame_index", "index", "step", "task_index"];
/// What may follow a time column's name.
const TIME_UNITS: [&str; 7] = ["_s", "_ms", "_us", "_ns", "_sec", "_secs", "_nsec"];
/// Units recognised without a blank before their bracket, where `pos[x]` could be meant.
const UNITS: [&str; 18] = [
    "m", "mm", "cm", "km", "um", "rad", "deg", "°", "s", "ms", "us", "ns", "N", "Nm", "m/s", "rad/s",
    "deg/s", "%",
];

/// What a column is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Value of the feature at this position.
    Feature(usize),
    /// A time, at this position among the times.
    Time(usize),
    /// Which demonstration the frame belongs to.
    Label,
    /// Not needed.
    Dropped,
}

/// The columns of a file: at least one of them is a feature, and at most one is the label.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    /// Their names, without units.
    pub(super) names: Vec<String>,
    /// What they are for.
    pub(super) roles: Vec<Role>,
    /// The features among them.
    pub(super) features: Arc<[Feature]>,
    /// Names of the times among them.
    pub(super) times: Vec<String>,
    /// Name of the label among them.
    pub(super) label: Option<String>,
}

impl Columns {
    /// The columns under these headings.
    ///
    /// # Errors
    ///
    /// When a name is missing or there twice, two columns name the demonstration, or no column is a feature.
    pub(super) fn new(headings: Vec<Feature>) -> Result<Self, String> {
        if headings.is_empty() {
            return Err("there are no features".to_owned());
        }
        check_count(headings.len())?;
        check_names(&headings)?;
        let mut columns = Self::empty();
        let mut features = Vec::new();
        for (position, heading) in headings.into_iter().enumerate() {
            columns.names.push(heading.name.clone());
            let role = role_of(&heading.name, position);
            columns.roles.push(match role {
                Role::Feature(_) => Role::Feature(features.len()),
                Role::Time(_) => Role::Time(columns.times.len()),
                Role::Label | Role::Dropped => role,
            });
            match role {
                Role::Feature(_) => features.push(heading),
                Role::Time(_) => columns.times.push(heading.name),
                Role::Label => columns.set_label(&heading.name)?,
                Role::Dropped => {}
            }
        }
        if features.is_empty() {
            return Err(
                "there is no feature: every column is a time, a counter or names the demonstration".into()
            );
        }
        columns.features = features.into();
        Ok(columns)
    }

    /// `count` features called `f1`, `f2` and so on.
    pub(super) fn numbered(count: usize) -> Self {
        let names: Vec<String> = (1..=count).map(|number| format!("f{number}")).collect();
        Self {
            roles: (0..count).map(Role::Feature).collect(),
            features: names.iter().map(Feature::new).collect(),
            names,
            ..Self::empty()
        }
    }

    /// What a file's columns are called together.
    pub(super) fn noun(&self) -> &'static str {
        if self.features.len() == self.names.len() { "feature" } else { "column" }
    }

    fn empty() -> Self {
        Self { names: Vec::new(), roles: Vec::new(), features: Arc::new([]), times: Vec::new(), label: None }
    }

    fn set_label(&mut self, name: &str) -> Result<(), String> {
        match self.label.replace(name.to_owned()) {
            None => Ok(()),
            Some(first) => {
                Err(format!("both {first} and {name} tell demonstrations apart; expected one such column"))
            }
        }
    }
}

/// The name and the unit in a heading: `red.x [m]` and `red.x (m)` are the feature `red.x` in `m`.
pub(super) fn heading(text: &str) -> Feature {
    let text = text.trim();
    let opening = match text.chars().last() {
        Some(']') => '[',
        Some(')') => '(',
        _ => return Feature::new(text),
    };
    let Some((name, rest)) = text.rsplit_once(opening) else {
        return Feature::new(text);
    };
    let unit = rest[..rest.len() - 1].trim();
    let is_unit = UNITS.contains(&unit) || (name.ends_with(char::is_whitespace) && !is_number(unit));
    let name = name.trim_end();
    if unit.is_empty() || name.is_empty() || !is_unit {
        return Feature::new(text);
    }
    Feature { name: name.to_owned(), unit: Some(unit.to_owned()) }
}

fn is_number(text: &str) -> bool {
    text.parse::<f64>().is_ok()
}

fn role_of(name: &str, position: usize) -> Role {
    let name = name.to_ascii_lowercase();
    let is_one_of = |names: &[&str]| names.contains(&name.as_str());
    let stem = TIME_UNITS.iter().find_map(|suffix| name.strip_suffix(suffix)).unwrap_or(&name);
    if is_one_of(&DEMONSTRATION) {
        Role::Label
    } else if TIME.contains(&stem) {
        Role::Time(0)
    } else if is_one_of(&COUNTER) || (position == 0 && (name.is_empty() || name == "unnamed: 0")) {
        Role::Dropped
    } else {
        Role::Feature(0)
    }
}

/// Whether so many columns are credible.
///
/// # Errors
///
/// When there are more than [`MAX_COLUMNS`].
pub(super) fn check_count(count: usize) -> Result<(), String> {
    if count > MAX_COLUMNS {
        return Err(format!("more than {MAX_COLUMNS} columns"));
    }
    Ok(())
}

fn check_names(headings: &[Feature]) -> Result<(), String> {
    let mut seen = BTreeMap::new();
    for (index, heading) in headings.iter().enumerate() {
        let number = index + 1;
        if heading.name.is_empty() && index > 0 {
            return Err(format!("column {number} has no name"));
        }
        if let Some(first) = seen.insert(heading.name.as_str(), number) {
            return Err(format!("{} is there twice (columns {first} and {number})", quoted(&heading.name)));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_heading(text: &str, name: &str, unit: Option<&str>) {
        assert_eq!(heading(text), Feature { name: name.to_owned(), unit: unit.map(str::to_owned) });
    }

    #[test]
    fn a_unit_stands_in_brackets_behind_the_name() {
        check_heading(" red.x [m] ", "red.x", Some("m"));
        check_heading("red.x (mm)", "red.x", Some("mm"));
        check_heading("red.x[m]", "red.x", Some("m"));
        check_heading("force [kg m/s²]", "force", Some("kg m/s²"));
    }

    #[test]
    fn an_index_in_brackets_is_no_unit() {
        for text in ["pos[0]", "pos [0]", "pos[x]", "q(1)", "[m]", "x []", "x]", "()", "é)"] {
            check_heading(text, text, None);
        }
    }

    #[test]
    fn names_say_what_columns_are_for() {
        let names = ["", "Demo", "time_ms", "T [s]", "frame_index", "red_t", "x"];
        let columns = Columns::new(names.iter().map(|name| heading(name)).collect()).unwrap();
        let roles = [
            Role::Dropped,
            Role::Label,
            Role::Time(0),
            Role::Time(1),
            Role::Dropped,
            Role::Feature(0),
            Role::Feature(1),
        ];
        assert_eq!(columns.roles, roles);
    }
}
