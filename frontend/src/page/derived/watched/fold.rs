//! A run as it was after some of its events.

use std::collections::BTreeSet;

use goalgraph::pdfa::{Pdfa, Probabilities, StateId, Symbol, Word};
use goalgraph::protocol::api::StoredEvent;
use goalgraph::protocol::monitor::{RunOrigin, RunView};
use goalgraph::run::{Run, RunEvent};

use super::marks::ways_from;

/// A plan that took the place of another one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Replanned {
    /// Number of the event.
    pub(crate) number: u64,
    /// What was unavailable then, in the order of the alphabet.
    pub(crate) unavailable: Vec<Symbol>,
    /// The way of the plan before.
    pub(crate) before: Vec<(StateId, Symbol)>,
    /// The new plan.
    pub(crate) word: Word,
}

/// `run` as it was after `events`, its first ones; where they do not follow each other it stays as before that.
pub(super) fn replayed(
    run: RunView,
    pdfa: &Pdfa,
    probabilities: &Probabilities,
    events: &[StoredEvent],
) -> RunView {
    let mut fold = Run::new(pdfa);
    for event in events {
        if fold.apply(pdfa, probabilities, event.number, &event.happened).is_err() {
            break;
        }
    }
    let heard_at = events.last().map_or_else(|| run.began_at.clone(), |event| event.stored_at.clone());
    let origin = RunOrigin {
        run: run.run,
        executor: run.executor,
        specification: run.specification,
        name: run.name,
        revision: run.revision,
        sha256: run.sha256,
        began_at: run.began_at,
    };
    RunView::new(origin, &fold, heard_at)
}

/// The last new plan in `events`, the first ones of a run.
pub(super) fn replanned(pdfa: &Pdfa, events: &[StoredEvent]) -> Option<Replanned> {
    let last = events.iter().rposition(|event| matches!(event.happened, RunEvent::Replanned { .. }))?;
    let RunEvent::Replanned { word, .. } = &events[last].happened else { return None };
    let (mut unavailable, mut before) = (BTreeSet::new(), Vec::new());
    for event in &events[..last] {
        match &event.happened {
            RunEvent::Unavailable { sub_goal, .. } => {
                unavailable.insert(*sub_goal);
            }
            RunEvent::Available { sub_goal } => {
                unavailable.remove(sub_goal);
            }
            RunEvent::Planned { state, word, .. } | RunEvent::Replanned { state, word, .. } => {
                before = ways_from(pdfa, *state, word);
            }
            _ => {}
        }
    }
    let unavailable = unavailable.into_iter().collect();
    Some(Replanned { number: events[last].number, unavailable, before, word: word.clone() })
}

#[cfg(test)]
mod tests {
    use goalgraph::pdfa::Semantics;
    use goalgraph::run::{Departure, Phase};

    use super::*;

    const A: Symbol = Symbol(0);
    const B: Symbol = Symbol(1);
    const C: Symbol = Symbol(2);

    fn stored(happened: Vec<RunEvent>) -> Vec<StoredEvent> {
        let event = |(index, happened)| StoredEvent {
            number: index as u64 + 1,
            stored_at: format!("at {}", index + 1),
            happened_at: None,
            happened,
        };
        happened.into_iter().enumerate().map(event).collect()
    }

    fn view(pdfa: &Pdfa) -> RunView {
        let origin = RunOrigin {
            run: "r1".to_owned(),
            executor: "arm".to_owned(),
            specification: "s".to_owned(),
            name: String::new(),
            revision: 1,
            sha256: String::new(),
            began_at: "at 0".to_owned(),
        };
        RunView::new(origin, &Run::new(pdfa), "now".to_owned())
    }

    fn outage() -> Vec<StoredEvent> {
        stored(vec![
            RunEvent::Planned { state: StateId(0), word: vec![A, B, C], probability: 0.5 },
            RunEvent::Completed { sub_goal: A },
            RunEvent::Unavailable { sub_goal: B, reason: None },
            RunEvent::Replanned { state: StateId(1), word: vec![C], probability: 0.5 },
            RunEvent::Completed { sub_goal: C },
            RunEvent::Finished,
        ])
    }

    #[test]
    fn every_moment_of_a_run_is_the_fold_of_its_events_up_to_there() {
        let pdfa = Pdfa::from_words(&[vec![A, B, C], vec![A, C]]);
        let probabilities = pdfa.probabilities(Semantics::default());
        let at = |number: usize| replayed(view(&pdfa), &pdfa, &probabilities, &outage()[..number]);
        assert_eq!((at(0).trail, at(0).heard_at), (vec![], "at 0".to_owned()));
        assert_eq!(at(1).plan, [A, B, C]);
        assert_eq!((at(2).trail, at(2).plan), (vec![A], vec![B, C]));
        assert_eq!((at(4).unavailable, at(4).plan, at(4).replans), (vec![B], vec![C], 1));
        assert_eq!(
            (at(6).phase, at(6).trail, at(6).heard_at),
            (Phase::Finished, vec![A, C], "at 6".to_owned())
        );
    }

    #[test]
    fn a_replay_shows_where_a_run_left_the_automaton() {
        let pdfa = Pdfa::from_words(&[vec![A, B]]);
        let probabilities = pdfa.probabilities(Semantics::default());
        let events = stored(vec![RunEvent::Completed { sub_goal: A }, RunEvent::Completed { sub_goal: C }]);
        let run = replayed(view(&pdfa), &pdfa, &probabilities, &events);
        assert_eq!(run.departure, Some(Departure::NoWay { number: 2, state: StateId(1), sub_goal: C }));
    }

    #[test]
    fn the_last_new_plan_knows_what_was_unavailable_and_which_way_was_left() {
        let pdfa = Pdfa::from_words(&[vec![A, B, C], vec![A, C]]);
        let found = replanned(&pdfa, &outage()).expect("there is a new plan");
        assert_eq!((found.number, found.unavailable, found.word), (4, vec![B], vec![C]));
        assert_eq!(found.before.iter().map(|(_, symbol)| *symbol).collect::<Vec<_>>(), [A, B, C]);
        assert_eq!(replanned(&pdfa, &outage()[..3]), None);
    }
}
