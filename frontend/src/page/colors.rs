//! A color for every sub-goal. It never stands alone: wherever it is shown, so is the name.

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::pdfa::Symbol;
use goalgraph::specification::{Specification, SubGoal};

/// How many colors the style sheet has: those of Okabe and Ito, which survive color blindness.
pub(crate) const COLORS: usize = 8;

/// Words in the names of subsets, and the color that people expect then.
const EXPECTED: [(&str, usize); 14] = [
    ("red", 0),
    ("green", 1),
    ("blue", 2),
    ("yellow", 3),
    ("orange", 4),
    ("cyan", 5),
    ("sky", 5),
    ("purple", 6),
    ("pink", 6),
    ("violet", 6),
    ("magenta", 6),
    ("gray", 7),
    ("grey", 7),
    ("black", 7),
];

/// The color of a sub-goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Color {
    /// Which of the [`COLORS`].
    hue: usize,
    /// Which of the [`SHADES`] of it.
    shade: usize,
}

/// How many looks a color has: full, pale, outlined.
const SHADES: usize = 3;

impl Color {
    /// The classes that give the color.
    pub(crate) fn class(self) -> String {
        format!("c{} v{}", self.hue % COLORS, self.shade % SHADES)
    }
}

/// The color of every sub-goal: the one that an expert chose, or else an automatic one. A subset named after a color has that one, the other subsets take turns; the sub-goals of
/// one subset are shades of its color. Where there is one subset only, its sub-goals take turns.
pub(crate) fn colors(specification: &Specification) -> BTreeMap<Symbol, Color> {
    let groups: Vec<&str> = specification.sub_goals.iter().map(group).collect();
    let one_group = groups.iter().all(|group| *group == groups[0]);
    let names: Vec<&str> = if one_group {
        specification.sub_goals.iter().map(|sub_goal| sub_goal.name.as_str()).collect()
    } else {
        groups
    };
    let hues = hues(&names);
    let mut shades: BTreeMap<&str, usize> = BTreeMap::new();
    let mut colors = BTreeMap::new();
    for (sub_goal, name) in specification.sub_goals.iter().zip(names) {
        let shade = shades.entry(name).or_default();
        let automatic = Color { hue: hues.get(name).copied().unwrap_or(0), shade: *shade };
        let chosen = sub_goal.color.map(|color| Color { hue: usize::from(color), shade: 0 });
        colors.insert(sub_goal.id, chosen.unwrap_or(automatic));
        *shade += 1;
    }
    colors
}

/// What a sub-goal shares its hue with: its subset, where it has one.
fn group(sub_goal: &SubGoal) -> &str {
    sub_goal.ball.as_ref().map_or(&sub_goal.name, |ball| &ball.subset)
}

/// A hue for every distinct name: the expected one, or one that nobody has yet while there are such.
fn hues<'a>(names: &[&'a str]) -> BTreeMap<&'a str, usize> {
    let mut taken = BTreeSet::new();
    let mut hues: BTreeMap<&str, usize> = BTreeMap::new();
    for &name in names {
        if let Some(hue) = expected_hue(name).filter(|hue| !hues.contains_key(name) && taken.insert(*hue)) {
            hues.insert(name, hue);
        }
    }
    let mut free = (0..COLORS).filter(|hue| !taken.contains(hue)).chain((0..COLORS).cycle());
    for &name in names {
        hues.entry(name).or_insert_with(|| free.next().unwrap_or(0));
    }
    hues
}

fn expected_hue(name: &str) -> Option<usize> {
    let name = name.to_lowercase();
    let mut words = name.split(|character: char| !character.is_alphabetic());
    words.find_map(|word| EXPECTED.iter().find(|(expected, _)| *expected == word).map(|(_, hue)| *hue))
}

/// The colors of subsets that have no sub-goals yet.
pub(crate) fn subset_classes(names: &[&str]) -> Vec<String> {
    let hues = hues(names);
    names.iter().map(|name| Color { hue: hues.get(name).copied().unwrap_or(0), shade: 0 }.class()).collect()
}

#[cfg(test)]
mod tests {
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;
    use goalgraph::specification::Ball;

    use super::*;

    /// The color of each sub-goal, given as its subset and its name.
    fn colored(sub_goals: &[(&str, &str)]) -> Vec<String> {
        let word = sub_goals.iter().map(|(_, name)| (*name).to_owned()).collect::<Vec<_>>();
        let mut specification = infer_words("", Semantics::default(), &[word]);
        for (sub_goal, (subset, _)) in specification.sub_goals.iter_mut().zip(sub_goals) {
            let (subset, features, center) = ((*subset).to_owned(), Vec::new(), Vec::new());
            sub_goal.ball = Some(Ball { subset, features, center, radius: 1.0 });
        }
        colors(&specification).values().map(|color| color.class()).collect()
    }

    #[test]
    fn a_subset_named_after_a_color_has_it() {
        assert_eq!(colored(&[("yellow", "yellow 1"), ("red", "red 1")]), ["c3 v0", "c0 v0"]);
    }

    #[test]
    fn there_are_as_many_colors_as_can_be_chosen() {
        assert_eq!(COLORS, usize::from(goalgraph::edit::COLORS));
    }

    #[test]
    fn a_color_that_was_chosen_comes_first() {
        let mut specification =
            infer_words("", Semantics::default(), &[vec!["a".to_owned(), "b".to_owned()]]);
        specification.sub_goals[0].color = Some(6);
        let classes: Vec<String> = colors(&specification).values().map(|color| color.class()).collect();
        assert_eq!(classes, ["c6 v0", "c1 v0"]);
    }

    #[test]
    fn the_other_subsets_take_turns_around_the_expected_colors() {
        assert_eq!(
            colored(&[("lid", "lid 1"), ("red", "red 1"), ("cup", "cup 1")]),
            ["c1 v0", "c0 v0", "c2 v0"]
        );
    }

    #[test]
    fn the_sub_goals_of_a_subset_are_shades_of_its_color() {
        let sub_goals = [("red", "red 1"), ("red", "red 2"), ("lid", "lid 1"), ("red", "red 3")];
        assert_eq!(colored(&sub_goals), ["c0 v0", "c0 v1", "c1 v0", "c0 v2"]);
    }

    #[test]
    fn the_sub_goals_of_the_only_subset_take_turns() {
        let names: Vec<String> = (0..9).map(|index| format!("place {index}")).collect();
        let sub_goals: Vec<(&str, &str)> = names.iter().map(|name| ("drone", name.as_str())).collect();
        let colors = colored(&sub_goals);
        assert_eq!((colors[0].as_str(), colors[7].as_str(), colors[8].as_str()), ("c0 v0", "c7 v0", "c0 v0"));
    }
}
