//! Where frames stand in a JSON document.

use std::collections::BTreeSet;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::cells::Text;
use super::names::FeatureList;
use crate::import::column::check_count;
use crate::import::text::quoted;

/// What is done with frames as they are read.
pub(super) trait Frames {
    /// Reads a frame that is a list of values.
    fn list<'de, A: SeqAccess<'de>>(&mut self, cells: A) -> Result<(), A::Error>;
    /// Reads a frame that is an object with a value per feature.
    fn object<'de, A: MapAccess<'de>>(&mut self, cells: A) -> Result<(), A::Error>;
    /// The frames of a demonstration are complete; `name` is what the file calls it.
    fn end_demonstration(&mut self, name: Option<String>) -> Result<(), String>;
}

/// How a document is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// One list of frames.
    Frames,
    /// A list of demonstrations with frames each.
    Demonstrations,
    /// A list of values per feature, read by [`super::series::Series`].
    Series,
}

/// What a document holds beside the frames.
#[derive(Debug)]
pub(super) struct Outline {
    pub(super) kind: Kind,
    pub(super) features: Option<FeatureList>,
    /// Its other keys, in their order.
    pub(super) others: Vec<String>,
}

/// Reads a whole document and hands its frames to `F`.
pub(super) struct Document<'a, F>(pub(super) &'a mut F);

/// Reads a list of frames.
struct FrameList<'a, F>(&'a mut F);

/// Reads one frame.
struct Frame<'a, F>(&'a mut F);

/// Reads a list of demonstrations.
struct DemonstrationList<'a, F>(&'a mut F);

/// Reads one demonstration of such a list.
struct ListedDemonstration<'a, F>(&'a mut F);

/// Prefixes an error with where it is; the parser keeps the line.
pub(super) fn within<E: Error>(place: impl fmt::Display) -> impl FnOnce(E) -> E {
    move |error| E::custom(format_args!("{place}: {error}"))
}

/// The visitors above, as what they read is of one JSON type or two.
macro_rules! seed {
    ($seed:ident) => {
        impl<'de, F: Frames> DeserializeSeed<'de> for $seed<'_, F> {
            type Value = <Self as Visitor<'de>>::Value;

            fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
                deserializer.deserialize_any(self)
            }
        }
    };
}

seed!(Document);
seed!(FrameList);
seed!(Frame);
seed!(DemonstrationList);
seed!(ListedDemonstration);

impl<'de, F: Frames> Visitor<'de> for Document<'_, F> {
    type Value = Outline;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an object or a list of frames")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, frames: A) -> Result<Outline, A::Error> {
        FrameList(self.0).visit_seq(frames)?;
        self.0.end_demonstration(None).map_err(A::Error::custom)?;
        Ok(Outline { kind: Kind::Frames, features: None, others: Vec::new() })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Outline, A::Error> {
        let mut outline = Outline { kind: Kind::Series, features: None, others: Vec::new() };
        let mut name = None;
        let mut seen = BTreeSet::new();
        while let Some(key) = entries.next_key::<String>()? {
            if !seen.insert(key.clone()) {
                return Err(A::Error::custom(format_args!("the key {} is there twice", quoted(&key))));
            }
            match key.as_str() {
                "features" => outline.features = Some(entries.next_value()?),
                "name" => name = entries.next_value_seed(Text)?,
                "frames" => {
                    entries.next_value_seed(FrameList(&mut *self.0))?;
                    outline.kind = Kind::Frames;
                }
                "demonstrations" => {
                    entries.next_value_seed(DemonstrationList(&mut *self.0))?;
                    outline.kind = Kind::Demonstrations;
                }
                "format" => refuse_specification(entries.next_value_seed(Text)?.as_deref())?,
                _ => {
                    entries.next_value::<IgnoredAny>()?;
                    outline.others.push(key);
                    check_count(outline.others.len()).map_err(A::Error::custom)?;
                }
            }
        }
        if seen.contains("frames") && seen.contains("demonstrations") {
            return Err(A::Error::custom("there are frames and demonstrations; expected one of them"));
        }
        if outline.kind == Kind::Frames {
            self.0.end_demonstration(name).map_err(A::Error::custom)?;
        }
        Ok(outline)
    }
}

fn refuse_specification<E: Error>(format: Option<&str>) -> Result<(), E> {
    match format {
        Some("goalgraph-specification") => {
            Err(E::custom("this is a specification of Goalgraph; expected demonstrations"))
        }
        _ => Ok(()),
    }
}

impl<'de, F: Frames> Visitor<'de> for FrameList<'_, F> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a list of frames")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut frames: A) -> Result<(), A::Error> {
        for number in 0_usize.. {
            let frame = frames.next_element_seed(Frame(&mut *self.0));
            if frame.map_err(within(format_args!("frame {number}")))?.is_none() {
                break;
            }
        }
        Ok(())
    }
}

impl<'de, F: Frames> Visitor<'de> for Frame<'_, F> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a list of values, or an object with a value per feature")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, cells: A) -> Result<(), A::Error> {
        self.0.list(cells)
    }

    fn visit_map<A: MapAccess<'de>>(self, cells: A) -> Result<(), A::Error> {
        self.0.object(cells)
    }
}

impl<'de, F: Frames> Visitor<'de> for DemonstrationList<'_, F> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a list of demonstrations")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut demonstrations: A) -> Result<(), A::Error> {
        for number in 0_usize.. {
            let demonstration = demonstrations.next_element_seed(ListedDemonstration(&mut *self.0));
            if demonstration.map_err(within(format_args!("demonstration {number}")))?.is_none() {
                break;
            }
        }
        Ok(())
    }
}

impl<'de, F: Frames> Visitor<'de> for ListedDemonstration<'_, F> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an object with frames")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<(), A::Error> {
        let mut name = None;
        let mut seen = BTreeSet::new();
        while let Some(key) = entries.next_key::<String>()? {
            match key.as_str() {
                "name" => name = entries.next_value_seed(Text)?,
                "frames" => entries.next_value_seed(FrameList(&mut *self.0))?,
                _ => drop(entries.next_value::<IgnoredAny>()?),
            }
            if !seen.insert(key.clone()) {
                return Err(A::Error::custom(format_args!("the key {} is there twice", quoted(&key))));
            }
        }
        self.0.end_demonstration(name).map_err(A::Error::custom)
    }
}
