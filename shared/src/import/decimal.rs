//! From the digits of a decimal number to the double nearest to it.

mod long;
mod nearest;
mod short;
#[cfg(test)]
mod tests;
mod word;

pub(super) use self::long::leading as long_decimal;
pub(super) use self::short::leading as short_decimal;

/// The finite number at the beginning of a text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leading {
    pub(super) value: f64,
    /// How many bytes it takes.
    pub(super) length: usize,
    /// What follows it, where it is not the end.
    pub(super) next: Option<u8>,
}

/// The number at the beginning of `bytes`; none is no proof that there is none.
///
/// Where it ends the text, it is bit for bit what [`str::parse`] makes of it: the double nearest to the decimal, of two
/// the even one.
pub(super) fn leading_decimal(bytes: &[u8]) -> Option<Leading> {
    match short_decimal(bytes) {
        None => long_decimal(bytes),
        short => short,
    }
}
