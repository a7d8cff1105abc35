//! The specification file.

use crate::specification::Specification;

/// The file `*.goalgraph.json`: [`Specification::to_json`].
pub fn json(specification: &Specification) -> String {
    specification.to_json()
}
