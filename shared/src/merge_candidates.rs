//! Which states may be one: the statistical test of ALERGIA (Carrasco and Oncina 1994) for pairs of states.

mod compatibility;
mod continuations;

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use crate::pdfa::StateId;
use crate::specification::Specification;

use self::compatibility::{Comparison, Evidence};
use self::continuations::Continuations;

/// How many states are looked at: those that most words pass.
const STATES: usize = 512;

/// How many pairs of states are compared in all, those that candidates lead to included.
const COMPARED: usize = 50_000;

/// How strict the test is, and how many candidates are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MergeTest {
    /// Probability, for one outcome, of taking equal states for different: above 0, at most 2. The smaller, the more
    /// states are compatible; 0.05 is usual.
    pub alpha: f64,
    /// At most this many candidates are returned.
    pub limit: usize,
}

impl Default for MergeTest {
    fn default() -> Self {
        Self { alpha: 0.05, limit: 20 }
    }
}

/// Two states that may be one.
#[derive(Clone, Debug, PartialEq)]
pub struct MergeCandidate {
    /// The state with the smaller id.
    pub kept: StateId,
    /// The other one.
    pub merged: StateId,
    /// The largest observed difference of frequencies divided by its Hoeffding bound, over all compared outcomes: below
    /// 1 the states are compatible.
    pub score: f64,
    /// How many outcomes were compared: symbols and ends, of these states and of those that the same words lead to.
    pub compared: usize,
    /// A demonstration that tells the two apart, the first there is: its rest after it has passed one of them is
    /// accepted from there, but not from the other.
    pub distinguished_by: Option<usize>,
}

/// The pairs of states that may be one, the most likely first.
///
/// Two states are compared outcome by outcome: by the frequencies f/n of every symbol and of the end among the n words
/// that pass each, which may differ by less than sqrt(ln(2/alpha)/2) · (1/sqrt n + 1/sqrt n'), Hoeffding's bound. So are
/// the states that the same symbol leads to from both, and so on; a pair is compared once. Evidence are the counts, never
/// the weights; states that no word passed are not compared.
///
/// First come the pairs that no demonstration distinguishes, then those of the lowest score, then those with more
/// evidence (for the less visited of the two), then the smaller ids. Of more than 512 states those that most words pass
/// are looked at. Pairs are ranked by their own outcomes first and followed only while they may be among the first; after
/// 50,000 comparisons of pairs the rest keep the score they have so far. Demonstrations count for what distinguishes as
/// far as (distinct rests) · (states) stays below 2 million.
///
/// # Complexity
///
/// O(N² · A) for N states (at most 512) and A symbols, and the comparisons named above.
///
/// # Example
///
/// ```
/// use goalgraph::merge_candidates::{MergeTest, merge_candidates};
/// # use goalgraph::specification::Specification;
/// # fn candidates(specification: &Specification) {
/// for candidate in merge_candidates(specification, MergeTest::default()) {
///     println!("{} into {}: {:.2}", candidate.merged, candidate.kept, candidate.score);
/// }
/// # }
/// ```
pub fn merge_candidates(specification: &Specification, test: MergeTest) -> Vec<MergeCandidate> {
    let evidence = Evidence::of(&specification.pdfa, test.alpha);
    let continuations = Continuations::of(specification);
    let states = evidence.most_seen(STATES);
    let mut open = BinaryHeap::new();
    for (index, &kept) in states.iter().enumerate() {
        for &merged in &states[index + 1..] {
            open.push(Ranked {
                distinguished_by: continuations.distinguishing(kept, merged),
                comparison: evidence.compare_once(kept, merged),
                followed: false,
                seen: evidence.seen(kept).min(evidence.seen(merged)),
                kept,
                merged,
            });
        }
    }
    let mut budget = COMPARED;
    let mut found = Vec::new();
    while found.len() < test.limit
        && let Some(mut best) = open.pop()
    {
        if best.followed || budget == 0 {
            found.push(best.candidate(&evidence));
        } else {
            best.comparison = evidence.compare(best.kept, best.merged, &mut budget);
            best.followed = true;
            open.push(best);
        }
    }
    found
}

/// A pair with what is known so far; its score only grows when it is followed. The greatest is the best.
struct Ranked {
    distinguished_by: Option<usize>,
    comparison: Comparison,
    followed: bool,
    seen: u64,
    /// Indices of the states.
    kept: usize,
    merged: usize,
}

impl Ranked {
    fn candidate(&self, evidence: &Evidence) -> MergeCandidate {
        MergeCandidate {
            kept: evidence.id(self.kept),
            merged: evidence.id(self.merged),
            score: self.comparison.score,
            compared: self.comparison.outcomes,
            distinguished_by: self.distinguished_by,
        }
    }
}

impl Ord for Ranked {
    fn cmp(&self, other: &Self) -> Ordering {
        let distinguished = other.distinguished_by.is_some().cmp(&self.distinguished_by.is_some());
        distinguished
            .then_with(|| other.comparison.score.total_cmp(&self.comparison.score))
            .then_with(|| self.seen.cmp(&other.seen))
            .then_with(|| (other.kept, other.merged).cmp(&(self.kept, self.merged)))
            .then_with(|| self.followed.cmp(&other.followed))
    }
}

impl PartialOrd for Ranked {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ranked {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Ranked {}

/// Position of each id in an ordered list.
fn positions(ids: impl Iterator<Item = StateId>) -> BTreeMap<StateId, usize> {
    ids.enumerate().map(|(position, id)| (id, position)).collect()
}
