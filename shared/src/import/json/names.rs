//! The first reading: what the features are called.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::document::Frames;
use crate::demonstration::Feature;
use crate::import::column::{check_count, heading};
use crate::import::text::quoted;

/// Keys of frames, in the order of their first appearance.
#[derive(Debug, Default)]
pub(super) struct Keys {
    names: Vec<String>,
    positions: BTreeMap<String, usize>,
}

/// Counts frames and collects their keys.
#[derive(Debug, Default)]
pub(super) struct Names {
    pub(super) keys: Keys,
    /// How many frames there are.
    pub(super) frames: usize,
    /// How many of them are lists.
    pub(super) lists: usize,
    /// How many of them are objects.
    pub(super) objects: usize,
    /// For each key, the last frame that had it, counted from 1.
    last: Vec<usize>,
}

/// The features that a document lists: their keys as written, and what these say.
#[derive(Debug)]
pub(super) struct FeatureList {
    pub(super) keys: Keys,
    pub(super) headings: Vec<Feature>,
}

/// Reads a key as its position among the keys, adding it when it is new.
struct AddedKey<'a>(&'a mut Keys, usize);

impl Keys {
    /// Keys by their names.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// The position of a key. Frames tend to have one order of keys, so `expected` is tried first.
    pub(super) fn position(&self, key: &str, expected: usize) -> Option<usize> {
        if self.names.get(expected).is_some_and(|name| name == key) {
            return Some(expected);
        }
        self.positions.get(key).copied()
    }

    fn push(&mut self, key: &str) -> usize {
        let position = self.names.len();
        self.names.push(key.to_owned());
        self.positions.insert(key.to_owned(), position);
        position
    }
}

impl Frames for Names {
    fn list<'de, A: SeqAccess<'de>>(&mut self, mut cells: A) -> Result<(), A::Error> {
        while cells.next_element::<IgnoredAny>()?.is_some() {}
        self.frames += 1;
        self.lists += 1;
        Ok(())
    }

    fn object<'de, A: MapAccess<'de>>(&mut self, mut cells: A) -> Result<(), A::Error> {
        self.frames += 1;
        self.objects += 1;
        let mut expected = 0;
        while let Some(position) = cells.next_key_seed(AddedKey(&mut self.keys, expected))? {
            check_count(self.keys.names.len()).map_err(A::Error::custom)?;
            self.last.resize(self.keys.names.len(), 0);
            if self.last[position] == self.frames {
                let key = quoted(&self.keys.names[position]);
                return Err(A::Error::custom(format_args!("{key} is there twice")));
            }
            self.last[position] = self.frames;
            cells.next_value::<IgnoredAny>()?;
            expected = position + 1;
        }
        Ok(())
    }

    fn end_demonstration(&mut self, _name: Option<String>) -> Result<(), String> {
        Ok(())
    }
}

impl<'de> DeserializeSeed<'de> for AddedKey<'_> {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for AddedKey<'_> {
    type Value = usize;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the name of a feature")
    }

    fn visit_str<E: Error>(self, key: &str) -> Result<usize, E> {
        Ok(self.0.position(key, self.1).unwrap_or_else(|| self.0.push(key)))
    }
}

impl<'de> Deserialize<'de> for FeatureList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "a feature's name, or an object with its name and unit")]
        enum Listed {
            Name(String),
            Feature { name: String, unit: Option<String> },
        }

        let mut list = Self { keys: Keys::default(), headings: Vec::new() };
        for listed in Vec::<Listed>::deserialize(deserializer)? {
            let (name, unit) = match listed {
                Listed::Name(name) => (name, None),
                Listed::Feature { name, unit } => (name, unit),
            };
            let named = heading(&name);
            list.headings.push(if unit.is_some() { Feature { name: named.name, unit } } else { named });
            list.keys.push(&name);
        }
        Ok(list)
    }
}
