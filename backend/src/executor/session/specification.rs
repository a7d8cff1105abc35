//! A specification that arrives is believed only when it is what it says.

use std::sync::Arc;

use crate::digest::sha256_hex;
use crate::executor::lines::short;
use goalgraph::specification::{Severity, Specification};

/// A specification that was accepted.
#[derive(Clone, Debug)]
pub(super) struct Held {
    /// SHA-256 of its content.
    pub(super) sha256: String,
    /// The specification.
    pub(super) specification: Arc<Specification>,
    revision: u64,
}

impl Held {
    /// `"Two stacks" r7 (0123456789ab)`
    pub(super) fn name(&self) -> String {
        format!("{:?} r{} ({})", self.specification.name, self.revision, short(&self.sha256))
    }
}

/// What was sent as the approved specification.
pub(super) struct Offer<'a> {
    /// Id of the specification.
    pub(super) specification: &'a str,
    /// Number of the revision.
    pub(super) revision: u64,
    /// Place of its approval in the journal.
    pub(super) approval: u64,
    /// The SHA-256 that the server names.
    pub(super) sha256: &'a str,
    /// The file.
    pub(super) content: &'a str,
}

/// Accepts the offer, or says in one sentence why not. `last_approval` is the place in the journal of the approval of the
/// same specification that was accepted last; 0 when there was none.
pub(super) fn examine(offer: &Offer, last_approval: u64) -> Result<Held, String> {
    let sha256 = sha256_hex(offer.content.as_bytes());
    if !sha256.eq_ignore_ascii_case(offer.sha256) {
        let (told, received) = (short(offer.sha256), short(&sha256));
        return Err(format!("the content has the SHA-256 {received}.., not {told}.. as the server says"));
    }
    if offer.approval < last_approval {
        let approval = offer.approval;
        return Err(format!(
            "approval {approval} is older than approval {last_approval}, which was accepted"
        ));
    }
    let specification = Specification::from_json(offer.content).map_err(|error| error.to_string())?;
    if let Some(problem) = specification.check().iter().find(|it| it.severity == Severity::Error) {
        return Err(problem.message.clone());
    }
    Ok(Held { sha256, specification: Arc::new(specification), revision: offer.revision })
}
