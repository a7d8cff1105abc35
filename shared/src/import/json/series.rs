//! JSON with a list of values per feature.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::cells::{Cell, Text};
use super::document::within;
use crate::import::column::{Columns, Role};
use crate::import::recording::{Part, Recorder, Row};
use crate::import::text::counted;

/// Reads a document whose keys, beside `name` and `format`, are these columns in their order.
pub(super) struct Series<'a>(pub(super) &'a Columns);

/// The values of one column.
#[derive(Default)]
struct Column {
    /// How many there are.
    length: usize,
    /// Values of a feature or times, NaN where undefined.
    values: Vec<f64>,
    /// Labels, each with the number of the frame behind its last.
    labels: Vec<(String, usize)>,
}

/// Reads the values of a column in this role, each by way of the row.
struct ColumnSeed<'a>(Role, &'a mut Row);

impl<'de> DeserializeSeed<'de> for Series<'_> {
    type Value = Vec<Part>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<Part>, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Series<'_> {
    type Value = Vec<Part>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an object with a list of values per feature")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Vec<Part>, A::Error> {
        let mut recorder = Recorder::new(self.0);
        let mut read = Vec::with_capacity(self.0.roles.len());
        let mut name = None;
        while let Some(key) = entries.next_key::<String>()? {
            match (key.as_str(), self.0.roles.get(read.len())) {
                ("name", _) => name = entries.next_value_seed(Text)?,
                ("format", _) | (_, None) => drop(entries.next_value::<IgnoredAny>()?),
                (_, Some(&role)) => {
                    let column = entries.next_value_seed(ColumnSeed(role, recorder.blank_row()));
                    read.push(column.map_err(within(&self.0.names[read.len()]))?);
                }
            }
        }
        check_lengths(self.0, &read).map_err(A::Error::custom)?;
        push_rows(&mut recorder, self.0, &read).map_err(A::Error::custom)?;
        Ok(recorder.finish().into_iter().map(|part| part.labelled(name.as_deref())).collect())
    }
}

fn check_lengths(columns: &Columns, read: &[Column]) -> Result<(), String> {
    let Some(first) = read.first() else { return Ok(()) };
    match read.iter().position(|column| column.length != first.length) {
        None => Ok(()),
        Some(other) => Err(format!(
            "{} has {}, but {} has {}",
            columns.names[other],
            counted(read[other].length, "value"),
            columns.names[0],
            first.length
        )),
    }
}

/// Adds the values frame by frame; all columns have one length.
fn push_rows(recorder: &mut Recorder<'_>, columns: &Columns, read: &[Column]) -> Result<(), String> {
    let mut runs = vec![0; read.len()];
    for frame in 0..read.first().map_or(0, |column| column.length) {
        let row = recorder.blank_row();
        for ((column, &role), run) in read.iter().zip(&columns.roles).zip(&mut runs) {
            match role {
                Role::Feature(feature) => row.values[feature] = column.values[frame],
                Role::Time(time) => row.times[time] = column.values[frame],
                Role::Label => {
                    *run += usize::from(column.labels[*run].1 <= frame);
                    row.label.push_str(&column.labels[*run].0);
                }
                Role::Dropped => {}
            }
        }
        recorder
            .push_row(frame)
            .map_err(|error| format!("frame {frame}: {}", error.message(|place| format!("frame {place}"))))?;
    }
    Ok(())
}

impl Column {
    /// Takes the next value out of the row.
    fn push(&mut self, role: Role, row: &mut Row) {
        self.length += 1;
        match role {
            Role::Feature(feature) => self.values.push(row.values[feature]),
            Role::Time(time) => self.values.push(row.times[time]),
            Role::Label => match self.labels.last_mut().filter(|(label, _)| *label == row.label) {
                Some((_, end)) => *end = self.length,
                None => self.labels.push((std::mem::take(&mut row.label), self.length)),
            },
            Role::Dropped => {}
        }
    }
}

impl<'de> DeserializeSeed<'de> for ColumnSeed<'_> {
    type Value = Column;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Column, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for ColumnSeed<'_> {
    type Value = Column;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a list of values, one per frame")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut cells: A) -> Result<Column, A::Error> {
        let Self(role, row) = self;
        let mut column = Column::default();
        loop {
            let cell = cells.next_element_seed(Cell { role, row });
            if cell.map_err(within(format_args!("frame {}", column.length)))?.is_none() {
                return Ok(column);
            }
            column.push(role, row);
        }
    }
}
