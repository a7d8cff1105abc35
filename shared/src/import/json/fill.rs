//! The second reading: the values of the frames.

use std::collections::BTreeSet;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::cells::Cell;
use super::document::{Frames, Kind, within};
use super::names::Keys;
use crate::import::column::Columns;
use crate::import::recording::{MAX_DEMONSTRATIONS, Part, Recorder};
use crate::import::text::{counted, quoted};

/// Collects frames into demonstrations.
pub(super) struct Fill<'a> {
    columns: &'a Columns,
    keys: Keys,
    recorder: Recorder<'a>,
    frame: usize,
    demonstrations: Vec<(Option<String>, Vec<Part>)>,
}

/// Reads a key as its position among the keys.
struct KnownKey<'a>(&'a Keys, usize);

impl<'a> Fill<'a> {
    /// No frames yet; `keys` are the columns' names as the file writes them.
    pub(super) fn new(columns: &'a Columns, keys: Keys) -> Self {
        Self { columns, keys, recorder: Recorder::new(columns), frame: 0, demonstrations: Vec::new() }
    }

    /// The demonstrations, each labelled with its name in the file or else, where several are listed, its number.
    ///
    /// # Errors
    ///
    /// When two have one name.
    pub(super) fn finish(self, kind: Kind) -> Result<Vec<Part>, String> {
        let is_one_of_many = kind == Kind::Demonstrations && self.demonstrations.len() > 1;
        let mut parts = Vec::new();
        for (number, (name, own)) in self.demonstrations.into_iter().enumerate() {
            let name = name.or_else(|| is_one_of_many.then(|| number.to_string()));
            parts.extend(own.into_iter().map(|part| part.labelled(name.as_deref())));
        }
        let mut seen = BTreeSet::new();
        match parts.iter().filter_map(|part| part.label.as_deref()).find(|label| !seen.insert(*label)) {
            Some(label) => Err(format!("two demonstrations are called {}", quoted(label))),
            None => Ok(parts),
        }
    }

    fn push_row<E: Error>(&mut self) -> Result<(), E> {
        let place_name = |place| format!("frame {place}");
        self.recorder.push_row(self.frame).map_err(|error| E::custom(error.message(place_name)))?;
        self.frame += 1;
        Ok(())
    }
}

impl Frames for Fill<'_> {
    fn list<'de, A: SeqAccess<'de>>(&mut self, mut cells: A) -> Result<(), A::Error> {
        let row = self.recorder.blank_row();
        let mut count = 0;
        for (&role, name) in self.columns.roles.iter().zip(&self.columns.names) {
            let cell = cells.next_element_seed(Cell { role, row }).map_err(within(name))?;
            count += usize::from(cell.is_some());
        }
        while cells.next_element::<IgnoredAny>()?.is_some() {
            count += 1;
        }
        let expected = self.columns.roles.len();
        if count != expected {
            let (values, columns) = (counted(count, "value"), counted(expected, self.columns.noun()));
            return Err(A::Error::custom(format_args!("{values}, but there are {columns}")));
        }
        self.push_row()
    }

    fn object<'de, A: MapAccess<'de>>(&mut self, mut cells: A) -> Result<(), A::Error> {
        let row = self.recorder.blank_row();
        let mut expected = 0;
        while let Some(position) = cells.next_key_seed(KnownKey(&self.keys, expected))? {
            let role = self.columns.roles[position];
            cells.next_value_seed(Cell { role, row }).map_err(within(&self.columns.names[position]))?;
            expected = position + 1;
        }
        self.push_row()
    }

    fn end_demonstration(&mut self, name: Option<String>) -> Result<(), String> {
        let recorder = std::mem::replace(&mut self.recorder, Recorder::new(self.columns));
        let parts = recorder.finish();
        if parts.is_empty() {
            return Err("there are no frames".to_owned());
        }
        if self.demonstrations.len() == MAX_DEMONSTRATIONS {
            return Err(format!("there are more than {MAX_DEMONSTRATIONS} demonstrations"));
        }
        self.demonstrations.push((name, parts));
        self.frame = 0;
        Ok(())
    }
}

impl<'de> DeserializeSeed<'de> for KnownKey<'_> {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for KnownKey<'_> {
    type Value = usize;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the name of a feature")
    }

    fn visit_str<E: Error>(self, key: &str) -> Result<usize, E> {
        let unknown = || E::custom(format_args!("{} is not among the features", quoted(key)));
        self.0.position(key, self.1).ok_or_else(unknown)
    }
}
