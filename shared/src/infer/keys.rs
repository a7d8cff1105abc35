//! The numbers that demonstrations go by while they are studied.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::demonstration::Demonstration;

/// The number that a demonstration goes by while it is studied. No other one gets it later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct DemonstrationKey(pub u64);

/// The demonstrations that were last studied, with their keys.
#[derive(Clone, Debug, Default)]
pub struct DemonstrationKeys {
    last: Vec<(Demonstration, DemonstrationKey)>,
    given: u64,
}

impl DemonstrationKeys {
    /// The keys of `demonstrations`, one each: that of the last time for the
    /// [same recording](Demonstration::is_same_recording), a new one for others. Those that are not among them are
    /// forgotten.
    ///
    /// # Complexity
    ///
    /// O(n log n) for n demonstrations, however long they are.
    pub fn number(&mut self, demonstrations: &[Demonstration]) -> Vec<DemonstrationKey> {
        let mut known: BTreeMap<usize, Vec<DemonstrationKey>> = BTreeMap::new();
        for (demonstration, key) in self.last.iter().rev() {
            known.entry(demonstration.address()).or_default().push(*key);
        }
        let mut new_key = || {
            self.given += 1;
            DemonstrationKey(self.given)
        };
        let key = |demonstration: &Demonstration| {
            known.get_mut(&demonstration.address()).and_then(Vec::pop).unwrap_or_else(&mut new_key)
        };
        let keys: Vec<DemonstrationKey> = demonstrations.iter().map(key).collect();
        self.last = demonstrations.iter().cloned().zip(keys.iter().copied()).collect();
        keys
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demonstration::Feature;

    #[test]
    fn a_recording_keeps_its_key_and_twice_the_same_are_two() {
        let read = || Demonstration::new("a", "", [Feature::new("x")].into(), vec![0.0]).unwrap();
        let (a, b, c) = (read(), read(), read());
        let mut keys = DemonstrationKeys::default();
        let mut number = |demonstrations: &[&Demonstration]| -> Vec<u64> {
            let demonstrations: Vec<Demonstration> = demonstrations.iter().copied().cloned().collect();
            keys.number(&demonstrations).into_iter().map(|key| key.0).collect()
        };
        assert_eq!(number(&[&a, &b]), [1, 2]);
        assert_eq!(number(&[&c, &b, &a, &a]), [3, 2, 1, 4]);
        assert_eq!(number(&[&a, &a]), [1, 4]);
        assert_eq!(number(&[&b]), [5]);
    }
}
