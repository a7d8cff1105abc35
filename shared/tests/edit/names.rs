//! Names of the task, of states and of sub-goals, and labels.

use goalgraph::edit::{COLORS, Edit, Outcome, Pruned};
use goalgraph::pdfa::Semantics;
use goalgraph::specification::Specification;

use crate::{A, B, edited, learned, q, refused, word};

/// The three edits that give a name.
fn namings(name: &str) -> [Edit; 3] {
    [
        Edit::RenameTask { name: name.to_owned() },
        Edit::RenameState { state: q(1), name: name.to_owned() },
        Edit::RenameSubGoal { symbol: A, name: name.to_owned() },
    ]
}

#[test]
fn whatever_people_can_read_is_a_name() {
    let before = learned(&["ab"]);
    let longest = "n".repeat(200);
    let names = [
        "🧱 rood/vert ½",
        "👩‍👩‍👧‍👦",
        "לבנה אדומה",
        "\u{202e}evil\u{202c}",
        "constructor",
        "__proto__",
        "hasOwnProperty",
        "<b>bold</b>",
        "\"quoted\" \\ {{x}}",
        " spaces stay ",
        &longest,
    ];
    for name in names {
        for edit in namings(name) {
            let (after, _) = edited(&before, &edit);
            let read = Specification::from_json(&after.to_json()).unwrap();
            let found = [read.name.as_str(), &read.sub_goals[0].name]
                .into_iter()
                .chain(read.pdfa.states[&q(1)].name.as_deref());
            assert!(found.into_iter().any(|found| found == name), "{name}");
        }
    }
}

#[test]
fn names_that_cannot_be_shown_are_refused() {
    let before = learned(&["ab"]);
    for edit in namings(&"n".repeat(10_000)) {
        refused(&before, &edit, "the name has 10000 characters; at most 200 are allowed");
    }
    for edit in namings("two\nlines") {
        let sentence = "the name has the control character '\\n'; only visible characters are allowed";
        refused(&before, &edit, sentence);
    }
    for edit in namings(" \u{3000} ") {
        refused(&before, &edit, "the name is blank");
    }
    refused(&before, &Edit::RenameTask { name: String::new() }, "the name is blank");
    refused(&before, &Edit::RenameState { state: q(9), name: "x".to_owned() }, "q9: there is no such state");
    let missing = Edit::RenameSubGoal { symbol: crate::Symbol(9), name: "x".to_owned() };
    refused(&before, &missing, "g9: there is no such sub-goal");
}

#[test]
fn an_empty_name_takes_the_name_of_a_state_away() {
    let before = learned(&["ab"]);
    let rename = |name: &str| Edit::RenameState { state: q(1), name: name.to_owned() };
    let (named, _) = edited(&before, &rename("half done"));
    assert_eq!(named.pdfa.states[&q(1)].name.as_deref(), Some("half done"));
    assert_eq!(edited(&named, &rename("")).0, before);
}

#[test]
fn colors_are_those_of_the_palette() {
    let before = learned(&["ab"]);
    let recolor = |color| Edit::RecolorSubGoal { symbol: A, color };
    let (after, _) = edited(&before, &recolor(Some(COLORS - 1)));
    assert_eq!(after.sub_goals[0].color, Some(7));
    assert_eq!(edited(&after, &recolor(None)).0, before);
    refused(&before, &recolor(Some(8)), "color: 8 must be below 8");
}

#[test]
fn labels_say_what_is_done_in_the_names_of_before() {
    let mut before = learned(&["ab", "b"]);
    before.sub_goals[0].name = "red 1".to_owned();
    before.sub_goals[1].name = "x".repeat(50);
    before.pdfa.states.get_mut(&q(2)).unwrap().name = Some("done".to_owned());
    let label = |edit: Edit| edit.label(&before);
    let long = format!("{}…", "x".repeat(39));
    let reweight =
        |outcome, probability| Edit::Reweight { state: q(0), outcome, probability, locked: [].into() };
    assert_eq!(label(Edit::MergeStates { kept: q(2), merged: q(3) }), "Merge q3 into done");
    assert_eq!(label(reweight(Outcome::Transition(A), 0.4)), "Reweight red 1 from q0 to 0.4");
    assert_eq!(label(reweight(Outcome::End, 2.0 / 3.0)), "Reweight the end in q0 to 0.6667");
    assert_eq!(label(Edit::PruneState { state: q(1), ways: Pruned::Cut }), "Prune q1");
    let healed = Edit::PruneTransition { source: q(0), symbol: B, ways: Pruned::Heal };
    assert_eq!(label(healed), format!("Prune {long} from q0, keep the ways past it"));
    assert_eq!(label(Edit::ForbidWord { word: word("aa"), first_new: q(9) }), "Forbid red 1, red 1");
    assert_eq!(label(Edit::AddWord { word: word(""), first_new: q(9) }), "Add the empty word");
    assert_eq!(label(Edit::AddWord { word: vec![A; 100_000], first_new: q(9) }).chars().count(), 44);
    assert_eq!(label(Edit::SetSemantics { semantics: Semantics::Published }), "Read weights as published");
    assert_eq!(
        label(Edit::PruneState { state: q(77), ways: Pruned::Cut }),
        "Prune q77",
        "also what is not there"
    );
}
