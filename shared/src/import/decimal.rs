//! From the digits of a decimal number to the double nearest to it.

mod long;
mod nearest;
mod short;
#[cfg(test)]
mod tests;
mod word;

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
#[expect(clippy::inline_always, reason = "a call for each cell costs as much as reading it")]
#[inline(always)]
pub(super) fn leading_decimal(bytes: &[u8]) -> Option<Leading> {
    short::leading(bytes).or_else(|| long::leading(bytes))
}
