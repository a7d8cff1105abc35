//! Numbers and sentences as people read them.

use goalgraph::layout::drawing::{probability_text, words_through};
use goalgraph::pdfa::{StateId, Symbol};
use goalgraph::specification::Specification;

/// A length or coordinate with four significant digits.
pub(crate) fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let digits_before = value.abs().log10().floor() as i32 + 1;
    let decimals = (4 - digits_before).clamp(0, 6) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A share in percent. Only nothing is 0%, and only all of it is 100%.
pub(crate) fn percent(part: usize, whole: usize) -> String {
    match (100.0 * part as f64 / whole.max(1) as f64).round() {
        share if share < 1.0 && part > 0 => "<1%".to_owned(),
        share if share > 99.0 && part < whole => ">99%".to_owned(),
        share => format!("{share:.0}%"),
    }
}

/// `1 frame`, `2 frames`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    let ending = if number == 1 { "" } else { "s" };
    format!("{} {noun}{ending}", grouped(number))
}

/// Digits in groups of three, from five digits on.
pub(crate) fn grouped(number: usize) -> String {
    let digits = number.to_string();
    if digits.len() < 5 {
        return digits;
    }
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .map(|group| std::str::from_utf8(group).unwrap_or_default())
        .collect();
    groups.join("\u{202f}")
}

/// Whether an expert has set a weight, so that it is not just its count.
pub(crate) fn is_expert(weight: f64, count: u64) -> bool {
    (weight - count as f64).abs() > 1e-9
}

/// A weight or probability with up to four decimals.
pub(crate) fn decimals(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A measure that may have no end: `0.12`, `∞`.
pub(crate) fn measure(value: f64) -> String {
    if value.is_infinite() { "∞".to_owned() } else { significant(value) }
}

/// A file size.
pub(crate) fn bytes(bytes: f64) -> String {
    match bytes {
        bytes if bytes < 1e3 => format!("{bytes:.0} B"),
        bytes if bytes < 1e6 => format!("{:.0} kB", bytes / 1e3),
        bytes => format!("{:.1} MB", bytes / 1e6),
    }
}

/// A file name from a task name: `Two stacks` gives `two-stacks`.
pub(crate) fn file_stem(task: &str) -> String {
    let dashed: String =
        task.to_lowercase().chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    let words: Vec<&str> = dashed.split('-').filter(|word| !word.is_empty()).collect();
    if words.is_empty() { "task".to_owned() } else { words.join("-") }
}

/// What a screen reader says of a state: `State q3, completed red 1, yellow 1`.
pub(crate) fn state_label(specification: &Specification, id: StateId) -> String {
    let Some(state) = specification.pdfa.states.get(&id) else { return format!("State {id}") };
    let names: Vec<String> = state.completed.iter().map(|&symbol| specification.name_of(symbol)).collect();
    let completed = if names.is_empty() {
        "nothing completed".to_owned()
    } else {
        format!("completed {}", names.join(", "))
    };
    match &state.name {
        Some(name) => format!("State {id}, {name}, {completed}"),
        None => format!("State {id}, {completed}"),
    }
}

/// What a screen reader says of a transition: `red 1 from q0 to q1, probability 0.67, 6 of 9`.
pub(crate) fn transition_label(
    specification: &Specification,
    source: StateId,
    symbol: Symbol,
    chance: f64,
) -> String {
    let name = specification.name_of(symbol);
    let Some(transition) = specification.pdfa.transition(source, symbol) else { return name };
    let (target, count) = (transition.target, transition.count);
    let total = specification.pdfa.states.get(&source).map_or(0, words_through);
    format!("{name} from {source} to {target}, probability {}, {count} of {total}", probability_text(chance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_nothing_is_no_percent_and_only_all_is_a_hundred() {
        let shares = [(0, 600), (1, 600), (7, 18), (599, 600), (600, 600), (0, 0)];
        assert_eq!(
            shares.map(|(part, whole)| percent(part, whole)),
            ["0%", "<1%", "39%", ">99%", "100%", "0%"]
        );
    }

    #[test]
    fn lengths_have_four_significant_digits() {
        let written = [0.0, 0.011_234_5, 1.5, -0.2, 812.0, 12_345.6].map(significant);
        assert_eq!(written, ["0", "0.01123", "1.5", "-0.2", "812", "12346"]);
    }

    #[test]
    fn counts_agree_with_their_nouns() {
        assert_eq!(count(1, "frame"), "1 frame");
        assert_eq!(count(12_345, "frame"), "12\u{202f}345 frames");
    }

    #[test]
    fn file_names_come_from_task_names() {
        assert_eq!(file_stem("Two stacks, by hand"), "two-stacks-by-hand");
        assert_eq!(file_stem(" / "), "task");
    }
}
