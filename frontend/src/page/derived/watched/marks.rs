//! A run in the drawing: where it is, where it was, where it is going.

use std::collections::{BTreeMap, BTreeSet};

use goalgraph::pdfa::{Pdfa, StateId, Symbol};
use goalgraph::protocol::monitor::RunView;
use goalgraph::run::{Departure, Phase};

use super::Replanned;

/// What a run makes of the drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct RunMarks {
    here: Option<StateId>,
    label: String,
    phase: Phase,
    departed: bool,
    passed_states: BTreeMap<StateId, usize>,
    passed: BTreeMap<(StateId, Symbol), usize>,
    ahead_states: BTreeSet<StateId>,
    ahead: BTreeSet<(StateId, Symbol)>,
    abandoned: BTreeSet<(StateId, Symbol)>,
    active: Option<(StateId, Symbol)>,
    unavailable: BTreeSet<Symbol>,
}

/// What a run makes of a state.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct StateMark {
    /// What the run does here, when it is here.
    pub(crate) here: Option<String>,
    /// How it stands, when it is here.
    pub(crate) phase: Phase,
    /// Whether it left the automaton here.
    pub(crate) departed: bool,
    /// How many steps ago it was here.
    pub(crate) age: Option<usize>,
    /// Whether it is going to be here.
    pub(crate) ahead: bool,
}

/// What a run makes of a transition.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct TransitionMark {
    /// Where it lies on the way of the run.
    pub(crate) way: Way,
    /// Whether the robot reports its sub-goal as unavailable.
    pub(crate) unavailable: bool,
}

/// Where a transition lies on the way of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Way {
    /// Beside it.
    #[default]
    Beside,
    /// It was taken so many steps ago.
    Taken(usize),
    /// It is being taken.
    Active,
    /// It is going to be taken.
    Ahead,
    /// It was going to be taken until the last new plan.
    Abandoned,
}

impl RunMarks {
    /// The marks of `run` in the automaton that it follows.
    pub(super) fn of(pdfa: &Pdfa, run: &RunView, replanned: Option<&Replanned>, label: String) -> Self {
        let here = run.state.or(run.states.last().copied());
        let steps = run.states.len().saturating_sub(1);
        let age = |index: usize| steps - 1 - index;
        let taken = || run.states.iter().copied().zip(run.trail.iter().copied()).take(steps).enumerate();
        let ahead: BTreeSet<_> = run
            .state
            .map(|state| ways_from(pdfa, state, &run.plan))
            .unwrap_or_default()
            .into_iter()
            .collect();
        let passed: BTreeMap<_, _> = taken().map(|(index, way)| (way, age(index))).collect();
        let before =
            replanned.filter(|_| !run.phase.is_over()).map(|it| it.before.as_slice()).unwrap_or_default();
        let left = |way: &&(StateId, Symbol)| !ahead.contains(way) && !passed.contains_key(way);
        Self {
            here,
            label,
            phase: run.phase,
            departed: matches!(run.departure, Some(Departure::NoWay { .. } | Departure::EndedEarly { .. })),
            passed_states: taken().map(|(index, (state, _))| (state, age(index) + 1)).collect(),
            abandoned: before.iter().filter(left).copied().collect(),
            passed,
            ahead_states: ahead
                .iter()
                .filter_map(|&(state, by)| Some(pdfa.transition(state, by)?.target))
                .collect(),
            ahead,
            active: run.state.zip(run.active),
            unavailable: run.unavailable.iter().copied().collect(),
        }
    }

    /// What becomes of a state.
    pub(crate) fn state(&self, id: StateId) -> StateMark {
        let is_here = self.here == Some(id);
        StateMark {
            here: is_here.then(|| self.label.clone()),
            phase: self.phase,
            departed: is_here && self.departed,
            age: self.passed_states.get(&id).copied(),
            ahead: self.ahead_states.contains(&id),
        }
    }

    /// What becomes of the transition by `symbol` out of `source`.
    pub(crate) fn transition(&self, source: StateId, symbol: Symbol) -> TransitionMark {
        let name = (source, symbol);
        let way = match self.passed.get(&name) {
            _ if self.active == Some(name) => Way::Active,
            _ if self.ahead.contains(&name) => Way::Ahead,
            Some(&age) => Way::Taken(age),
            None if self.abandoned.contains(&name) => Way::Abandoned,
            None => Way::Beside,
        };
        TransitionMark { way, unavailable: self.unavailable.contains(&symbol) }
    }
}

/// The transitions that `word` takes from `state` on, as far as it gets.
pub(super) fn ways_from(pdfa: &Pdfa, mut state: StateId, word: &[Symbol]) -> Vec<(StateId, Symbol)> {
    let mut ways = Vec::with_capacity(word.len());
    for &symbol in word {
        let Some(way) = pdfa.transition(state, symbol) else { break };
        ways.push((state, symbol));
        state = way.target;
    }
    ways
}

#[cfg(test)]
mod tests {
    use goalgraph::pdfa::Semantics;
    use goalgraph::protocol::monitor::RunOrigin;
    use goalgraph::run::{Run, RunEvent};

    use super::*;

    const A: Symbol = Symbol(0);
    const B: Symbol = Symbol(1);
    const C: Symbol = Symbol(2);

    /// The marks after `events` in the automaton of `abc` and `acb`: q0 -a-> q1 -b-> q2 -c-> q3, q1 -c-> q4 -b-> q3.
    fn marks(events: &[RunEvent], replanned: Option<&Replanned>) -> RunMarks {
        let pdfa = Pdfa::from_words(&[vec![A, B, C], vec![A, C, B]]);
        let probabilities = pdfa.probabilities(Semantics::default());
        let mut run = Run::new(&pdfa);
        for (index, event) in events.iter().enumerate() {
            run.apply(&pdfa, &probabilities, index as u64 + 1, event).expect("the events follow each other");
        }
        let origin = RunOrigin {
            run: String::new(),
            executor: String::new(),
            specification: String::new(),
            name: String::new(),
            revision: 1,
            sha256: String::new(),
            began_at: String::new(),
        };
        RunMarks::of(&pdfa, &RunView::new(origin, &run, String::new()), replanned, "running".to_owned())
    }

    fn planned(word: &[Symbol]) -> RunEvent {
        RunEvent::Planned { state: StateId(0), word: word.to_vec(), probability: 0.5 }
    }

    #[test]
    fn the_trail_grows_old_and_the_plan_lies_ahead() {
        let events = [
            planned(&[A, B, C]),
            RunEvent::Completed { sub_goal: A },
            RunEvent::Completed { sub_goal: B },
            RunEvent::Started { sub_goal: C },
        ];
        let marks = marks(&events, None);
        assert_eq!(marks.transition(StateId(0), A).way, Way::Taken(1));
        assert_eq!(marks.transition(StateId(1), B).way, Way::Taken(0));
        assert_eq!(marks.transition(StateId(2), C).way, Way::Active);
        assert_eq!(marks.state(StateId(2)).here.as_deref(), Some("running"));
        assert_eq!((marks.state(StateId(0)).age, marks.state(StateId(1)).age), (Some(2), Some(1)));
        assert!(marks.state(StateId(3)).ahead);
    }

    #[test]
    fn the_way_that_a_new_plan_leaves_is_marked_until_the_run_is_over() {
        let before = vec![(StateId(0), A), (StateId(1), B), (StateId(2), C)];
        let replanned = Replanned { number: 4, unavailable: vec![B], before, word: vec![C] };
        let mut events = vec![
            planned(&[A, B, C]),
            RunEvent::Completed { sub_goal: A },
            RunEvent::Unavailable { sub_goal: B, reason: None },
            RunEvent::Replanned { state: StateId(1), word: vec![C], probability: 0.5 },
        ];
        let marked = |events: &[RunEvent], source, symbol| {
            marks(events, Some(&replanned)).transition(StateId(source), symbol)
        };
        assert_eq!(marked(&events, 1, B), TransitionMark { way: Way::Abandoned, unavailable: true });
        assert_eq!(marked(&events, 1, C).way, Way::Ahead);
        assert_eq!(marked(&events, 0, A).way, Way::Taken(0), "what was taken was not left");
        events.push(RunEvent::Stopped);
        assert_eq!(marked(&events, 1, B).way, Way::Beside);
    }

    #[test]
    fn a_run_that_left_the_automaton_is_marked_where_it_left() {
        let events = [RunEvent::Completed { sub_goal: A }, RunEvent::Completed { sub_goal: A }];
        let marks = marks(&events, None);
        let state = marks.state(StateId(1));
        assert_eq!((state.departed, state.here.is_some()), (true, true));
        assert_eq!(marks.transition(StateId(0), A).way, Way::Taken(0));
    }
}
