//! Algorithm 2: from words to the automaton.

use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::{Pdfa, State, StateId, Symbol, Transition, Word};

/// The automaton while words are counted: flat tables, from which [`Pdfa`]'s ordered ones are made once at the end.
///
/// They are looked up once a symbol, so the hash must be a few instructions: that of `rustc-hash`, which is a
/// multiplication. It decides nothing: keys are compared, and nothing is read in the order of a table.
struct Counts {
    /// For each state how many words ended there.
    ends: Vec<u64>,
    /// For each state the symbols that are completed there, in their order.
    completed: Vec<Rc<[Symbol]>>,
    /// The state in which these symbols are completed.
    by_completed: FxHashMap<Rc<[Symbol]>, StateId>,
    /// The ways out of each state.
    ways: FxHashMap<WayKey, Way>,
}

/// Source and symbol of a way, in this order, in one word of the machine.
type WayKey = u64;

#[derive(Clone, Copy)]
struct Way {
    target: StateId,
    count: u64,
}

impl Pdfa {
    /// Infers the automaton from words: the paper's Algorithm 2.
    ///
    /// States stand for sets of completed symbols, so `ab` and `ba` end in the same state; they are numbered in the
    /// order in which the words reach them. Without words there is the initial state alone, not accepting.
    ///
    /// # Complexity
    ///
    /// O(S + T · (A + log T)) expected for S symbols in all words, T transitions and A symbols in the alphabet: one
    /// look-up a symbol, and a set of completed symbols only for a transition that is new.
    ///
    /// # Example
    ///
    /// ```
    /// use goalgraph::pdfa::{Pdfa, Symbol};
    ///
    /// let (a, b) = (Symbol(0), Symbol(1));
    /// let pdfa = Pdfa::from_words(&[vec![a, b], vec![b, a]]);
    /// assert_eq!(pdfa.states.len(), 4);
    /// ```
    pub fn from_words<'a>(words: impl IntoIterator<Item = &'a Word>) -> Self {
        let mut counts = Counts::new();
        for word in words {
            counts.count(word);
        }
        counts.into_pdfa()
    }
}

impl Counts {
    const INITIAL: StateId = StateId(0);

    fn new() -> Self {
        let nothing: Rc<[Symbol]> = Rc::new([]);
        Self {
            ends: vec![0],
            completed: vec![Rc::clone(&nothing)],
            by_completed: FxHashMap::from_iter([(nothing, Self::INITIAL)]),
            ways: FxHashMap::default(),
        }
    }

    /// Walks `word` from the initial state, adding what is missing and counting every step.
    fn count(&mut self, word: &[Symbol]) {
        let mut state = Self::INITIAL;
        for &symbol in word {
            state = match self.ways.get_mut(&key(state, symbol)) {
                Some(way) => {
                    way.count += 1;
                    way.target
                }
                None => self.add_way(state, symbol),
            };
        }
        self.ends[state.0 as usize] += 1;
    }

    /// Adds the way out of `source` by `symbol`, and the state that it leads to where that is new.
    #[cold]
    fn add_way(&mut self, source: StateId, symbol: Symbol) -> StateId {
        let target = self.target(source, symbol);
        self.ways.insert(key(source, symbol), Way { target, count: 1 });
        target
    }

    /// The state in which `symbol` is completed beside all that is completed in `source`.
    fn target(&mut self, source: StateId, symbol: Symbol) -> StateId {
        let before = &self.completed[source.0 as usize];
        let Err(place) = before.binary_search(&symbol) else { return source };
        let completed: Rc<[Symbol]> = [&before[..place], &[symbol], &before[place..]].concat().into();
        if let Some(&state) = self.by_completed.get(&completed) {
            return state;
        }
        let state = StateId(self.completed.len() as u32);
        self.ends.push(0);
        self.completed.push(Rc::clone(&completed));
        self.by_completed.insert(completed, state);
        state
    }

    fn into_pdfa(self) -> Pdfa {
        let mut ways: Vec<(WayKey, Way)> = self.ways.into_iter().collect();
        ways.sort_unstable_by_key(|&(key, _)| key);
        let states = self.completed.iter().zip(&self.ends).zip((0..).map(StateId));
        let mut ways = ways.as_slice();
        let states = states.map(|((completed, &end_count), id)| {
            let (own, others) = ways.split_at(ways.partition_point(|&(key, _)| source(key) == id));
            ways = others;
            let transition = |&(key, Way { target, count }): &(WayKey, Way)| {
                (symbol(key), Transition { target, count, weight: count as f64 })
            };
            let state = State {
                name: None,
                completed: completed.iter().copied().collect(),
                accepting: end_count > 0,
                end_count,
                end_weight: end_count as f64,
                transitions: own.iter().map(transition).collect(),
            };
            (id, state)
        });
        Pdfa { initial: Self::INITIAL, states: states.collect() }
    }
}

fn key(source: StateId, symbol: Symbol) -> WayKey {
    u64::from(source.0) << 32 | u64::from(symbol.0)
}

fn source(key: WayKey) -> StateId {
    StateId((key >> 32) as u32)
}

fn symbol(key: WayKey) -> Symbol {
    Symbol(key as u32)
}
