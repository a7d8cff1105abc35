//! Addresses that open a revision: `/#specification=ID&revision=7`.

use thiserror::Error;

/// A revision of a specification of the server.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Link {
    /// The specification's id.
    pub(crate) id: String,
    /// The revision; none for the last one.
    pub(crate) revision: Option<u64>,
}

/// Why an address opens nothing.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("The link is not understood: expected #specification=ID&revision=NUMBER, not #{0}.")]
pub(crate) struct LinkError(String);

impl Link {
    /// Reads what stands after the `#` of an address; none when it is about something else.
    ///
    /// # Errors
    ///
    /// When it is about a specification and cannot be read.
    pub(crate) fn read(hash: &str) -> Result<Option<Self>, LinkError> {
        let hash = hash.strip_prefix('#').unwrap_or(hash);
        let refused = || LinkError(hash.chars().take(60).collect());
        let parts: Vec<(&str, &str)> = hash.split('&').filter_map(|part| part.split_once('=')).collect();
        let value = |name: &str| parts.iter().find(|(it, _)| *it == name).map(|(_, value)| *value);
        match (value("specification"), value("revision")) {
            (None, None) => Ok(None),
            (Some(id), revision) if is_id(id) => {
                let number = |text: &str| text.parse().ok().filter(|number| *number > 0).ok_or_else(refused);
                Ok(Some(Self { id: id.to_owned(), revision: revision.map(number).transpose()? }))
            }
            _ => Err(refused()),
        }
    }

    /// What stands after the `#`.
    pub(crate) fn hash(&self) -> String {
        let revision = self.revision.map(|number| format!("&revision={number}"));
        format!("specification={}{}", self.id, revision.unwrap_or_default())
    }
}

/// Ids are letters, digits, hyphens and underscores.
fn is_id(text: &str) -> bool {
    let allowed = |character: char| character.is_ascii_alphanumeric() || "-_".contains(character);
    (1..=80).contains(&text.len()) && text.chars().all(allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_is_read_as_it_was_written() {
        for revision in [Some(7), None] {
            let link = Link { id: "3f2b-a".to_owned(), revision };
            assert_eq!(Link::read(&format!("#{}", link.hash())), Ok(Some(link)));
        }
    }

    #[test]
    fn other_addresses_are_no_links() {
        for hash in ["", "#", "#top", "#a=b"] {
            assert_eq!(Link::read(hash), Ok(None), "{hash}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_refused_in_a_sentence() {
        for hash in ["#specification=", "#revision=7", "#specification=../x", "#specification=a&revision=0"] {
            assert!(Link::read(hash).is_err(), "{hash}");
        }
        let refusal = Link::read("#specification=a&revision=seven").unwrap_err().to_string();
        let expected = "The link is not understood: expected #specification=ID&revision=NUMBER, \
                        not #specification=a&revision=seven.";
        assert_eq!(refusal, expected);
    }
}
