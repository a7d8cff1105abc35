//! Access tokens: what they look like and how they are hashed.

use std::fmt;

use argon2::password_hash::phc::PasswordHash;
use argon2::password_hash::{PasswordHasher, PasswordVerifier, try_generate_salt};
use argon2::{Algorithm, Argon2, Params, Version};
use uuid::Uuid;

use crate::digest::hex;

/// What every token begins with.
const PREFIX: &str = "goalgraph";
/// Digits of a secret: 256 bits.
const SECRET_DIGITS: usize = 64;

/// Why a token could not be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TokenError {
    /// The system gave no random numbers.
    #[error("the system gives no random numbers: {0}")]
    NoRandomness(String),
    /// The hash could not be computed.
    #[error("the token could not be hashed: {0}")]
    Hash(String),
}

/// A token as its owner holds it: `goalgraph_<id>_<secret>`.
#[derive(Clone, PartialEq, Eq)]
pub struct Token {
    id: String,
    secret: String,
}

impl Token {
    /// A new token of 256 random bits.
    ///
    /// # Errors
    ///
    /// When the system gives no random numbers.
    pub fn generate() -> Result<Self, TokenError> {
        Ok(Self { id: Uuid::new_v4().simple().to_string(), secret: random_secret()? })
    }

    /// Reads a token; none when the text is not one.
    pub fn parse(text: &str) -> Option<Self> {
        let mut parts = text.split('_');
        let is_token = parts.next()? == PREFIX;
        let (id, secret) = (parts.next()?, parts.next()?);
        let is_id = !id.is_empty() && id.bytes().all(is_digit);
        let is_secret = secret.len() == SECRET_DIGITS && secret.bytes().all(is_digit);
        let is_whole = is_token && is_id && is_secret && parts.next().is_none();
        is_whole.then(|| Self { id: id.to_owned(), secret: secret.to_owned() })
    }

    /// The part that is no secret.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The whole token, secret included: to be shown once, to its owner.
    pub fn reveal(&self) -> String {
        format!("{PREFIX}_{}_{}", self.id, self.secret)
    }

    /// The secret's hash (Argon2id, 19 MiB, two passes) with a salt of its own, as a PHC string. It takes some 20 ms.
    ///
    /// # Errors
    ///
    /// When the system gives no random numbers.
    pub fn hash(&self) -> Result<String, TokenError> {
        let failed = |error: argon2::password_hash::Error| TokenError::Hash(error.to_string());
        let salt = random_bytes()?;
        let hash: PasswordHash =
            hasher()?.hash_password_with_salt(self.secret.as_bytes(), &salt).map_err(failed)?;
        Ok(hash.to_string())
    }

    /// Whether `hash` is of this token's secret; takes as long whether it is or not. A text that is no hash is of none.
    pub fn verify(&self, hash: &str) -> bool {
        PasswordHash::new(hash)
            .is_ok_and(|hash| Argon2::default().verify_password(self.secret.as_bytes(), &hash).is_ok())
    }
}

/// Without the secret.
impl fmt::Debug for Token {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Token({})", self.id)
    }
}

/// 256 random bits as 64 hexadecimal digits.
///
/// # Errors
///
/// When the system gives no random numbers.
pub fn random_secret() -> Result<String, TokenError> {
    Ok(hex(&[random_bytes()?, random_bytes()?].concat()))
}

/// 128 random bits of the system.
fn random_bytes() -> Result<[u8; 16], TokenError> {
    try_generate_salt().map_err(|error| TokenError::NoRandomness(error.to_string()))
}

fn hasher() -> Result<Argon2<'static>, TokenError> {
    let params = Params::new(19 * 1024, 2, 1, None).map_err(|error| TokenError::Hash(error.to_string()))?;
    Ok(Argon2::new(Algorithm::Argon2id, Version::V0x13, params))
}

fn is_digit(byte: u8) -> bool {
    byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_verified_by_its_own_hash_alone() {
        let (token, other) = (Token::generate().unwrap(), Token::generate().unwrap());
        let hash = token.hash().unwrap();
        assert!(hash.starts_with("$argon2id$v=19$m=19456,t=2,p=1$"), "{hash}");
        assert!(token.verify(&hash) && !other.verify(&hash));
        assert_ne!(token.hash().unwrap(), hash, "every hash has its own salt");
        assert!(!token.verify("") && !token.verify("$argon2id$v=19$m=19456,t=2,p=1$"));
    }

    #[test]
    fn a_token_survives_being_written_and_nothing_else_is_one() {
        let token = Token::generate().unwrap();
        let text = token.reveal();
        assert_eq!(Token::parse(&text), Some(token.clone()));
        assert!(!format!("{token:?}").contains(&token.secret));
        for wrong in
            ["", "goalgraph", "goalgraph_a_b", &text[1..], &text[..text.len() - 1], &format!("{text}_")]
        {
            assert_eq!(Token::parse(wrong), None, "{wrong}");
        }
        assert_eq!(Token::parse(&text.to_uppercase()), None);
    }
}
