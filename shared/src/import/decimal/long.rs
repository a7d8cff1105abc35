//! Decimals of as many digits as doubles are written with, with or without an exponent.

use super::Leading;
use super::nearest::nearest;
use super::word::{self, WORD, eight};

/// So many digits always fit into 64 bits.
const MOST_DIGITS: usize = 19;
/// Most digits of an exponent.
const MOST_EXPONENT_DIGITS: usize = 3;
/// A sign, the digits, a point, an exponent with its sign, and a word more.
const WINDOW: usize = 40;
/// The powers of ten by which a number makes room for as many more digits.
const POWERS_OF_TEN: [u64; WORD + 1] =
    [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// The number at the beginning of `bytes` where it is not too long and enough text follows it.
pub(in crate::import) fn leading(bytes: &[u8]) -> Option<Leading> {
    let window: &[u8; WINDOW] = bytes.first_chunk()?;
    let sign = usize::from(window[0] == b'-');
    let (mut number, mut length) = digits(0, window, sign)?;
    let mut count = length - sign;
    let mut power = 0;
    if window[length] == b'.' {
        let point = length;
        (number, length) = digits(number, window, point + 1)?;
        power = length - point - 1;
        count += power;
    }
    if count == 0 || count > MOST_DIGITS {
        return None;
    }
    if window[length] | 0x20 == b'e' {
        let exponent = exponent(window, length + 1)?;
        power = power.checked_add_signed(-exponent.value)?;
        length = exponent.end;
    }
    let value = nearest(number, power)?;
    Some(Leading { value: if sign == 1 { -value } else { value }, length, next: window.get(length).copied() })
}

/// `number` with the digits at `start` behind its own, and where they end; of more digits than fit into 64 bits the number
/// is not told.
#[inline]
fn digits(mut number: u64, window: &[u8; WINDOW], start: usize) -> Option<(u64, usize)> {
    let mut at = start;
    while at + WORD < WINDOW {
        let digits = word::digits(eight(window, at));
        let count = word::count(digits);
        number = number.wrapping_mul(POWERS_OF_TEN[count]).wrapping_add(word::number(digits, count));
        at += count;
        if count < WORD {
            return Some((number, at));
        }
    }
    None
}

/// What stands behind an `e`.
struct Exponent {
    value: isize,
    end: usize,
}

#[inline]
fn exponent(window: &[u8; WINDOW], start: usize) -> Option<Exponent> {
    let sign = window.get(start).filter(|&&byte| byte == b'-' || byte == b'+');
    let start = start + usize::from(sign.is_some());
    if start + WORD > WINDOW {
        return None;
    }
    let digits = word::digits(eight(window, start));
    let count = word::count(digits);
    let value = (word::number(digits, count) as usize).cast_signed();
    let value = if sign == Some(&b'-') { -value } else { value };
    (1..=MOST_EXPONENT_DIGITS).contains(&count).then_some(Exponent { value, end: start + count })
}
