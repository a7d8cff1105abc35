//! Single values of a JSON document.

use std::fmt;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::import::cell::is_undefined;
use crate::import::column::Role;
use crate::import::recording::Row;
use crate::import::text::quoted;

/// Reads a value into the place of `role` in the row.
pub(super) struct Cell<'a> {
    pub(super) role: Role,
    pub(super) row: &'a mut Row,
}

/// Reads a text or a number as text; anything else is skipped.
pub(super) struct Text;

impl Cell<'_> {
    fn set(self, value: f64, text: impl FnOnce() -> String) {
        match self.role {
            Role::Feature(feature) => self.row.values[feature] = value,
            Role::Time(time) => self.row.times[time] = value,
            Role::Label => self.row.label = text(),
            Role::Dropped => {}
        }
    }
}

impl<'de> DeserializeSeed<'de> for Cell<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        match self.role {
            Role::Dropped => IgnoredAny::deserialize(deserializer).map(drop),
            _ => deserializer.deserialize_any(self),
        }
    }
}

impl Visitor<'_> for Cell<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self.role {
            Role::Label => "what the demonstration is called",
            _ => "a number, or null where undefined",
        })
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<(), E> {
        self.set(value, || value.to_string());
        Ok(())
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<(), E> {
        self.set(value as f64, || value.to_string());
        Ok(())
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<(), E> {
        self.set(value as f64, || value.to_string());
        Ok(())
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        self.set(f64::NAN, String::new);
        Ok(())
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<(), E> {
        if matches!(self.role, Role::Feature(_)) && !is_undefined(text) {
            let text = quoted(text);
            return Err(E::custom(format_args!(
                "{text} is a text; expected a number, or null where undefined"
            )));
        }
        self.set(f64::NAN, || text.trim().to_owned());
        Ok(())
    }
}

impl<'de> DeserializeSeed<'de> for Text {
    type Value = Option<String>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Option<String>, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Text {
    type Value = Option<String>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a text")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
        Ok(Some(text.trim().to_owned()).filter(|text| !text.is_empty()))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        Ok(Some(value.to_string()))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        Ok(Some(value.to_string()))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
        Ok(Some(value.to_string()))
    }

    fn visit_unit<E: Error>(self) -> Result<Self::Value, E> {
        Ok(None)
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<Self::Value, E> {
        Ok(None)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Self::Value, A::Error> {
        while elements.next_element::<IgnoredAny>()?.is_some() {}
        Ok(None)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        while entries.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(None)
    }
}
