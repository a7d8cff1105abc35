//! Roles: what somebody may do.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// What somebody may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// See everything.
    Viewer,
    /// Also save and delete.
    Editor,
    /// Also approve, revoke and command executors.
    Approver,
    /// Connect as an executor, and nothing else.
    Executor,
}

/// A name that is none of a role.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0:?} is no role; expected viewer, editor, approver or executor")]
pub struct UnknownRole(String);

impl Role {
    /// Every role.
    pub const ALL: [Self; 4] = [Self::Viewer, Self::Editor, Self::Approver, Self::Executor];

    /// The role's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Viewer => "viewer",
            Self::Editor => "editor",
            Self::Approver => "approver",
            Self::Executor => "executor",
        }
    }

    /// Whether this role may do what `needed` may: a viewer less than an editor less than an approver, and an executor
    /// only what executors may.
    pub fn allows(self, needed: Self) -> bool {
        match (self, needed) {
            (Self::Executor, _) | (_, Self::Executor) => self == needed,
            _ => self >= needed,
        }
    }
}

impl fmt::Display for Role {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for Role {
    type Err = UnknownRole;

    fn from_str(name: &str) -> Result<Self, UnknownRole> {
        let found = Self::ALL.into_iter().find(|role| role.name() == name);
        found.ok_or_else(|| UnknownRole(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roles_include_the_lesser_ones_and_executors_stand_apart() {
        let allowed = |role: Role| Role::ALL.map(|needed| role.allows(needed));
        assert_eq!(allowed(Role::Viewer), [true, false, false, false]);
        assert_eq!(allowed(Role::Editor), [true, true, false, false]);
        assert_eq!(allowed(Role::Approver), [true, true, true, false]);
        assert_eq!(allowed(Role::Executor), [false, false, false, true]);
    }

    #[test]
    fn a_role_is_read_by_its_name() {
        assert!(Role::ALL.into_iter().all(|role| role.name().parse() == Ok(role)));
        let message = "\"root\" is no role; expected viewer, editor, approver or executor";
        assert_eq!("root".parse::<Role>().map_err(|error| error.to_string()), Err(message.to_owned()));
    }
}
