//! Decimals of at most eight digits without an exponent, as in most recordings.

use super::Leading;
use super::word::{self, WORD, eight};

/// A sign, seven digits, a point, and eight bytes and one more.
const WINDOW: usize = 18;
/// What such a number may be divided by: the powers of ten, and behind these what gives it the other sign.
const DIVISORS: [f64; 2 * WORD] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, -1e0, -1e1, -1e2, -1e3, -1e4, -1e5, -1e6, -1e7];

/// The number at the beginning of `bytes` where it is short, has digits before its point, and enough text follows it.
#[expect(clippy::inline_always, reason = "a call for each cell costs as much as reading it")]
#[inline(always)]
pub(in crate::import) fn leading(bytes: &[u8]) -> Option<Leading> {
    let window: &[u8; WINDOW] = bytes.first_chunk()?;
    let sign = usize::from(window[0] == b'-');
    let before = word::digits(eight(window, sign));
    let whole = word::count(before);
    if whole == 0 || whole == WORD {
        return None;
    }
    let point = sign + whole;
    let (digits, decimals, length) = if window[point] == b'.' {
        let behind = word::digits(eight(window, point + 1));
        let decimals = word::count(behind);
        (word::first(before, whole) | behind << (8 * whole), decimals, point + 1 + decimals)
    } else {
        (before, 0, point)
    };
    let next = window[length];
    let may_have_exponent = next >= b'A';
    if whole + decimals > WORD || may_have_exponent {
        return None;
    }
    // Both are doubles, so that one division rounds as it must (Clinger 1990, *How to read floating point numbers
    // accurately*).
    let value =
        word::number(digits, whole + decimals).cast_signed() as f64 / DIVISORS[WORD * sign + decimals];
    Some(Leading { value, length, next: Some(next) })
}
