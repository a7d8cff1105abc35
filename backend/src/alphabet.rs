//! Sub-goals by what people call them.

use goalgraph::pdfa::Symbol;
use goalgraph::specification::{Specification, SubGoal};

/// The sub-goal that `text` names: by its id, by its name in any case, or by what only its name starts with.
///
/// # Errors
///
/// One sentence with the alphabet when no sub-goal is meant, or several may be.
pub fn find(specification: &Specification, text: &str) -> Result<Symbol, String> {
    let sub_goals = &specification.sub_goals;
    if let Some(sub_goal) = sub_goals.iter().find(|sub_goal| sub_goal.id.to_string() == text) {
        return Ok(sub_goal.id);
    }
    let wanted = text.to_lowercase();
    let name_is = |sub_goal: &&SubGoal| sub_goal.name == text;
    let name_reads = |sub_goal: &&SubGoal| sub_goal.name.to_lowercase() == wanted;
    let name_starts =
        |sub_goal: &&SubGoal| !wanted.is_empty() && sub_goal.name.to_lowercase().starts_with(&wanted);
    let matches: [Vec<&SubGoal>; 3] = [
        sub_goals.iter().filter(name_is).collect(),
        sub_goals.iter().filter(name_reads).collect(),
        sub_goals.iter().filter(name_starts).collect(),
    ];
    match matches.iter().find(|found| !found.is_empty()).map(Vec::as_slice) {
        Some([only]) => Ok(only.id),
        Some(several) => {
            let several: Vec<&str> = several.iter().map(|sub_goal| sub_goal.name.as_str()).collect();
            let (several, alphabet) = (several.join(", "), describe(specification));
            Err(format!("{text:?} may be any of {several}; the sub-goals are {alphabet}"))
        }
        None => Err(format!("there is no sub-goal {text:?}; the sub-goals are {}", describe(specification))),
    }
}

/// The alphabet in one line: `g0 (red 1), g1 (yellow 1)`.
fn describe(specification: &Specification) -> String {
    let described = |sub_goal: &SubGoal| format!("{} ({})", sub_goal.id, sub_goal.name);
    specification.sub_goals.iter().map(described).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;

    use super::*;

    fn check(names: &[&str], text: &str, expected: Result<u32, &str>) {
        let word = names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        let specification = infer_words("", Semantics::default(), &[word]);
        let found = find(&specification, text).map(|symbol| symbol.0);
        assert_eq!(found, expected.map_err(str::to_owned), "{text}");
    }

    #[test]
    fn an_id_comes_before_a_name_and_a_name_before_a_beginning() {
        check(&["red 1", "yellow 1"], "g1", Ok(1));
        check(&["g1", "g0"], "g1", Ok(1));
        check(&["red 1", "yellow 1"], "Yellow 1", Ok(1));
        check(&["red 1", "yellow 1"], "yell", Ok(1));
        check(&["red 10", "red 1"], "red 1", Ok(1));
        check(&["Red", "red"], "red", Ok(1));
    }

    #[test]
    fn what_is_unknown_or_ambiguous_is_answered_with_the_alphabet() {
        let alphabet = "the sub-goals are g0 (red 1), g1 (red 2)";
        let names = ["red 1", "red 2"];
        check(&names, "red", Err(&format!("\"red\" may be any of red 1, red 2; {alphabet}")));
        check(&names, "blue", Err(&format!("there is no sub-goal \"blue\"; {alphabet}")));
        check(&names, "", Err(&format!("there is no sub-goal \"\"; {alphabet}")));
    }
}
