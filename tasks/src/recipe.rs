//! From a recipe to a recorded task.

use crate::chance::Chance;
use crate::layout::Layout;
use crate::manner::Manner;
use crate::orders::apportion;
use crate::perform::perform;
use crate::sensing::{Sensing, Sightings, sense};
use crate::task::{Place, Recording, Task, TrueSubset, Unit};

/// Everything that decides a task, but for chance.
pub(crate) struct Recipe {
    pub(crate) name: String,
    pub(crate) description: String,
    pub(crate) layout: Layout,
    pub(crate) manner: Manner,
    pub(crate) sensing: Sensing,
    pub(crate) notation: Notation,
    pub(crate) demonstrations: usize,
}

/// How values are named and written.
#[derive(Clone, Debug)]
pub(crate) struct Notation {
    /// Between the name of a thing and the name of an axis.
    pub(crate) separator: &'static str,
    /// Names of the recorded axes: the first two or all three of a point.
    pub(crate) axes: &'static [&'static str],
    pub(crate) unit: Unit,
}

impl Recipe {
    /// Records the demonstrations, in an order that tells nothing about their words.
    pub(crate) fn record(self, seed: u64) -> Task {
        let words = self.words(seed);
        let demonstrations = words.into_iter().enumerate();
        let demonstrations =
            demonstrations.map(|(index, word)| self.demonstration(index, word, seed)).collect();
        let subsets: Vec<TrueSubset> = self.subsets();
        Task {
            features: subsets.iter().flat_map(|subset| subset.features.clone()).collect(),
            places: self.places(),
            name: self.name,
            description: self.description,
            unit: self.notation.unit,
            rate_hz: self.manner.rate_hz,
            subsets,
            demonstrations,
        }
    }

    fn words(&self, seed: u64) -> Vec<Vec<usize>> {
        let orders = &self.layout.orders;
        let at_least = if self.layout.has_optional_sites() { 2 } else { 1 };
        let counts = apportion(orders, self.demonstrations, at_least);
        let mut words = Vec::with_capacity(self.demonstrations);
        for (order, count) in orders.iter().zip(counts) {
            words.extend(std::iter::repeat_n(order.word.clone(), count));
        }
        Chance::new(seed, 1).shuffle(&mut words);
        words
    }

    fn demonstration(&self, index: usize, word: Vec<usize>, seed: u64) -> Recording {
        let mut chance = Chance::new(seed, 2 + index as u64);
        let performance = perform(&self.layout, &word, &self.manner, &mut chance);
        let (sensing, rate_hz) = (&self.sensing, self.manner.rate_hz);
        let sightings = sense(&performance, &self.layout, sensing, rate_hz, &mut chance);
        Recording {
            name: format!("demo_{index:02}"),
            frames: self.notation.frames(&sightings),
            word,
            rests: performance.rests,
        }
    }

    fn subsets(&self) -> Vec<TrueSubset> {
        let objects = self.layout.objects.iter();
        let subset =
            |name: &String| TrueSubset { name: name.clone(), features: self.notation.features(name) };
        objects.map(|object| subset(&object.name)).collect()
    }

    fn places(&self) -> Vec<Place> {
        let sites = self.layout.sites.iter();
        sites
            .map(|site| Place {
                name: site.name.clone(),
                subset: self.layout.objects[site.object].name.clone(),
                center: self.notation.values(&site.center).collect(),
            })
            .collect()
    }
}

impl Notation {
    fn features(&self, name: &str) -> Vec<String> {
        let axes = self.axes.iter();
        axes.map(|axis| format!("{name}{}{axis}", self.separator)).collect()
    }

    fn values<'a>(&'a self, point: &'a [f64; 3]) -> impl Iterator<Item = f64> + 'a {
        let recorded = &point[..self.axes.len()];
        recorded.iter().map(|value| value * self.unit.per_base())
    }

    fn frames(&self, sightings: &Sightings) -> Vec<Vec<f64>> {
        let undefined = [f64::NAN; 3];
        let row = |row: &Vec<Option<[f64; 3]>>| {
            row.iter()
                .flat_map(|point| self.values(point.as_ref().unwrap_or(&undefined)).collect::<Vec<_>>())
                .collect()
        };
        sightings.iter().map(row).collect()
    }
}
