//! How the work stands with the server, in words.

use crate::page::model::{Lineage, Server};

/// What it depends on.
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(super) struct Asked<'a> {
    /// What the work is on the server.
    pub(super) lineage: Option<&'a Lineage>,
    /// The present place of the history; none without work.
    pub(super) position: Option<usize>,
    /// Whether the work differs from that revision.
    pub(super) changed: bool,
    /// Whether a save is under way.
    pub(super) saving: bool,
    /// Whether a save waits.
    pub(super) queued: bool,
    /// Whether the server did not answer last.
    pub(super) offline: bool,
    /// The specification that the server was heard of last, and its last revision.
    pub(super) head: Option<(String, u64)>,
}

/// How the work stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Standing {
    /// In the bar: `r7`, and a word or two.
    pub(crate) short: String,
    /// As a sentence.
    pub(crate) long: String,
    /// Whether something waits for somebody.
    pub(crate) pressing: bool,
    /// Whether the revision is the approved one.
    pub(crate) approved: bool,
}

impl Standing {
    /// How the work stands with `server`.
    pub(super) fn of(server: &Server, asked: &Asked) -> Self {
        let say = |short: &str, long: &str, pressing: bool| Self {
            short: short.to_owned(),
            long: long.to_owned(),
            pressing,
            approved: false,
        };
        match (server, asked.lineage) {
            (Server::Absent, _) => say(
                "In this browser",
                "This page works without a server: the work is kept in this browser. Export what others need.",
                false,
            ),
            _ if asked.position.is_none() => say("", "There is nothing to save yet.", false),
            _ if asked.saving => say("Saving", "The server is saving.", false),
            _ if asked.queued => {
                say("Waits to be saved", "The server does not answer; the save is sent when it does.", true)
            }
            (Server::Locked, _) => say("Locked", "The server asks for a token. Log in to save.", true),
            (_, None) => say("Not saved", "This work is not on the server yet.", false),
            (_, Some(lineage)) => Self::kept(lineage, asked),
        }
    }

    fn kept(lineage: &Lineage, asked: &Asked) -> Self {
        let number = lineage.kept.revision;
        let here = asked.position.and_then(|position| lineage.revisions.get(&position).copied());
        let newer = asked.head.as_ref().filter(|(id, head)| *id == lineage.kept.id && *head > number);
        let approved = lineage.kept.approved == Some(number) && !asked.changed;
        let mark = if approved { ", approved" } else { "" };
        let (short, long) = match here.filter(|here| *here != number && asked.changed) {
            Some(here) => (
                format!("r{here} again"),
                format!("The same as revision {here}, on top of revision {number}"),
            ),
            None if asked.changed => {
                (format!("r{number}, changed"), format!("Revision {number}, changed since"))
            }
            None => (format!("r{number}{mark}"), format!("Revision {number}{mark}")),
        };
        let (short, long) = match newer {
            Some((_, head)) => {
                (format!("{short}; r{head} is newer"), format!("{long}; revision {head} is newer"))
            }
            None => (short, long),
        };
        let (offline, pressing) =
            if asked.offline { (" The server does not answer.", true) } else { ("", newer.is_some()) };
        let short = if asked.offline { format!("{short}, offline") } else { short };
        Self { short, long: format!("{long}.{offline}"), pressing, approved }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use goalgraph::protocol::api::{Role, Session};

    use super::*;
    use crate::page::model::Kept;

    fn lineage() -> Lineage {
        let kept = Kept {
            id: "a".to_owned(),
            revision: 7,
            etag: String::new(),
            sha256: String::new(),
            approved: Some(7),
        };
        Lineage { from: 0, kept, revisions: BTreeMap::from([(0, 5), (2, 7)]) }
    }

    fn asked(lineage: Option<&Lineage>) -> Asked<'_> {
        Asked {
            lineage,
            position: Some(2),
            changed: false,
            saving: false,
            queued: false,
            offline: false,
            head: None,
        }
    }

    fn short(asked: &Asked) -> String {
        let session = Session { name: None, role: Role::Editor, tokens_needed: false };
        Standing::of(&Server::Present(session), asked).short
    }

    #[test]
    fn the_bar_says_which_revision_the_work_is() {
        let lineage = lineage();
        let same = asked(Some(&lineage));
        assert_eq!(short(&asked(None)), "Not saved");
        assert_eq!(short(&same), "r7, approved");
        assert_eq!(short(&Asked { changed: true, ..asked(Some(&lineage)) }), "r7, changed");
        assert_eq!(short(&Asked { changed: true, position: Some(0), ..asked(Some(&lineage)) }), "r5 again");
        let head = Some(("a".to_owned(), 8));
        assert_eq!(short(&Asked { head, ..asked(Some(&lineage)) }), "r7, approved; r8 is newer");
    }

    #[test]
    fn what_is_under_way_or_waits_comes_first() {
        let lineage = lineage();
        assert_eq!(short(&Asked { saving: true, ..asked(Some(&lineage)) }), "Saving");
        assert_eq!(
            short(&Asked { queued: true, offline: true, ..asked(Some(&lineage)) }),
            "Waits to be saved"
        );
        assert_eq!(short(&Asked { offline: true, ..asked(Some(&lineage)) }), "r7, approved, offline");
    }

    #[test]
    fn without_a_server_the_work_is_in_the_browser() {
        assert_eq!(Standing::of(&Server::Absent, &asked(None)).short, "In this browser");
        assert_eq!(short(&Asked { position: None, ..asked(None) }), "");
    }
}
