//! From the text of a cell to its value.

/// The character between whole number and fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Decimal {
    /// `0.5`.
    Point,
    /// `0.5` and also `0,5`, as spreadsheets of many countries write into tables separated by semicolons.
    PointOrComma,
}

/// Why a cell has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellError {
    /// A number beyond every finite one, or infinity itself.
    Infinite,
    /// No number at all.
    Text,
}

/// The number in a trimmed cell, NaN when it says that the value is undefined.
///
/// # Errors
///
/// When the number is not finite or there is something else.
pub(super) fn number(cell: &[u8], decimal: Decimal) -> Result<f64, CellError> {
    match leading_number(cell) {
        Some((value, length)) if length == cell.len() => Ok(value),
        _ if cell.is_empty() => Ok(f64::NAN),
        _ => unusual_number(str::from_utf8(cell).map_err(|_| CellError::Text)?, decimal),
    }
}

/// The finite number at the beginning of `bytes` and its length; none is no proof that there is none.
///
/// Where it ends the text, it is bit for bit what [`str::parse`] makes of it: the double nearest to the decimal, of two
/// the even one.
#[inline]
pub(super) fn leading_number(bytes: &[u8]) -> Option<(f64, usize)> {
    short_decimal(bytes).or_else(|| any_decimal(bytes))
}

/// Most digits of a short decimal: so many fit into 64 bits.
const SHORT: usize = 18;
/// Up to here every whole number is a double.
const LARGEST_EXACT: u64 = 1 << 53;
/// The powers of ten that a short decimal may be divided by, all of them doubles.
const POWERS_OF_TEN: [f64; SHORT + 1] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18];

/// The number at the beginning of `bytes` where it is of few digits, without an exponent, as in most recordings.
///
/// Both its digits and the power of ten below them are doubles then, so that one division rounds it as it must be
/// (Clinger 1990, *How to read floating point numbers accurately*).
#[inline]
fn short_decimal(bytes: &[u8]) -> Option<(f64, usize)> {
    let sign = usize::from(bytes.first() == Some(&b'-'));
    let unsigned = &bytes[sign..];
    let (number, whole) = digits(0, unsigned);
    let has_point = unsigned.get(whole) == Some(&b'.');
    let point = usize::from(has_point);
    let (number, decimals) = if has_point { digits(number, &unsigned[whole + 1..]) } else { (number, 0) };
    let length = whole + point + decimals;
    let is_short = (1..=SHORT).contains(&(whole + decimals)) && number <= LARGEST_EXACT;
    if !is_short || matches!(unsigned.get(length), Some(b'e' | b'E')) {
        return None;
    }
    let value = number as f64 / POWERS_OF_TEN[decimals];
    Some((if sign == 1 { -value } else { value }, sign + length))
}

/// `number` with the digits at the beginning of `bytes` behind its own, and how many these are; of more than [`SHORT`]
/// digits the number is not told.
#[inline]
fn digits(mut number: u64, bytes: &[u8]) -> (u64, usize) {
    let mut count = 0;
    for byte in bytes {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit));
        count += 1;
    }
    (number, count)
}

/// The finite number at the beginning of `bytes`, whatever its length, mostly without bignums (Lemire 2021, *Number
/// parsing at a gigabyte per second*).
fn any_decimal(bytes: &[u8]) -> Option<(f64, usize)> {
    fast_float2::parse_partial(bytes).ok().filter(|(value, _): &(f64, usize)| value.is_finite())
}

fn unusual_number(text: &str, decimal: Decimal) -> Result<f64, CellError> {
    match text.parse::<f64>() {
        Ok(value) if value.is_infinite() => Err(CellError::Infinite),
        Ok(value) if value.is_nan() => Ok(f64::NAN),
        Ok(value) => Ok(value),
        Err(_) if is_undefined(text) => Ok(f64::NAN),
        Err(_) if decimal == Decimal::PointOrComma && text.contains(',') && !text.contains('.') => {
            number(text.replacen(',', ".", 1).as_bytes(), Decimal::Point)
        }
        Err(_) => Err(CellError::Text),
    }
}

/// Whether a trimmed cell says that its value is undefined.
pub(super) fn is_undefined(text: &str) -> bool {
    text.is_empty() || ["nan", "na", "n/a", "null", "none"].iter().any(|word| text.eq_ignore_ascii_case(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undefined_is_written_in_many_ways() {
        for text in ["", "nan", "NaN", "-nan", "NA", "n/a", "null", "NULL", "None"] {
            assert!(number(text.as_bytes(), Decimal::Point).is_ok_and(f64::is_nan), "{text}");
        }
    }

    #[test]
    fn what_is_not_finite_is_told_from_what_is_no_number() {
        for text in ["inf", "-Infinity", "1e999", "-1e400"] {
            assert_eq!(number(text.as_bytes(), Decimal::Point), Err(CellError::Infinite), "{text}");
        }
        for text in ["abc", "0x10", "1_000", "1,5", "1 2", "--1"] {
            assert_eq!(number(text.as_bytes(), Decimal::Point), Err(CellError::Text), "{text}");
        }
    }

    #[test]
    fn a_decimal_comma_is_read_where_it_separates_nothing() {
        assert_eq!(number(b"-0,25", Decimal::PointOrComma), Ok(-0.25));
        assert_eq!(number(b"1.234,5", Decimal::PointOrComma), Err(CellError::Text));
        assert_eq!(number(b"1,234,5", Decimal::PointOrComma), Err(CellError::Text));
    }
}
