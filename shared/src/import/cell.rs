//! From the text of a cell to its value.

use super::decimal::leading_decimal;
use crate::demonstration::LARGEST_VALUE;

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
    /// A number beyond [`LARGEST_VALUE`].
    TooLarge,
    /// No number at all.
    Text,
}

/// The number in a trimmed cell, NaN when it says that the value is undefined.
///
/// # Errors
///
/// When the number is not finite or too large, or there is something else.
pub(super) fn number(cell: &[u8], decimal: Decimal) -> Result<f64, CellError> {
    match leading_decimal(cell) {
        Some(decimal) if decimal.length == cell.len() => Ok(decimal.value),
        _ if cell.is_empty() => Ok(f64::NAN),
        _ => unusual_number(str::from_utf8(cell).map_err(|_| CellError::Text)?, decimal),
    }
}

fn unusual_number(text: &str, decimal: Decimal) -> Result<f64, CellError> {
    match text.parse::<f64>() {
        Ok(value) if value.is_infinite() => Err(CellError::Infinite),
        Ok(value) if value.is_nan() => Ok(f64::NAN),
        Ok(value) if value.abs() > LARGEST_VALUE => Err(CellError::TooLarge),
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
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn a_number_is_what_the_standard_library_makes_of_it(
            text in "[+-]?[0-9]{0,20}(\\.[0-9]{0,20})?([eE][+-]?[0-9]{0,3})?",
            value: f64,
            decimals in 0_usize..20,
        ) {
            for text in [text, format!("{value:?}"), format!("{value:e}"), format!("{value:.decimals$e}")] {
                let expected = text.parse::<f64>().ok().filter(|value| value.abs() <= LARGEST_VALUE);
                let found = number(text.as_bytes(), Decimal::Point).ok().filter(|value| !value.is_nan());
                prop_assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{:?}", text);
            }
        }
    }

    #[test]
    fn undefined_is_written_in_many_ways() {
        for text in ["", "nan", "NaN", "-nan", "NA", "n/a", "null", "NULL", "None"] {
            assert!(number(text.as_bytes(), Decimal::Point).is_ok_and(f64::is_nan), "{text}");
        }
    }

    #[test]
    fn what_is_not_finite_or_too_large_is_told_from_what_is_no_number() {
        for text in ["inf", "-Infinity", "1e999", "-1e400"] {
            assert_eq!(number(text.as_bytes(), Decimal::Point), Err(CellError::Infinite), "{text}");
        }
        for text in ["1e101", "-1.7e308"] {
            assert_eq!(number(text.as_bytes(), Decimal::Point), Err(CellError::TooLarge), "{text}");
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
