//! Decimals are what the standard library makes of them.

use proptest::prelude::*;

use super::leading_decimal;
use super::nearest::nearest;

/// What may follow a number in a file: not enough to be read quickly, and enough.
const FOLLOWING: [&str; 3] = ["", ",1", ",2.5,0.000000,1.234567,-0.5,17,0.123456,0.25\n"];

/// A decimal of any length.
fn decimal() -> impl Strategy<Value = String> {
    prop_oneof![
        "[+-]?[0-9]{1,25}",
        "-?[0-9]{0,9}\\.[0-9]{0,9}",
        "[+-]?[0-9]{0,25}\\.[0-9]{0,25}",
        "[+-]?[0-9]{0,20}\\.[0-9]{0,20}[eE][+-]?[0-9]{0,4}",
        "0\\.0{0,20}[0-9]{1,40}(e-?[0-9]{1,2})?",
        any::<f64>().prop_map(|value| format!("{value:?}")),
        any::<f64>().prop_map(|value| format!("{value:e}")),
        half_way(),
    ]
}

/// Half way between two doubles, and a little beside.
fn half_way() -> impl Strategy<Value = String> {
    prop_oneof![
        (0_u64..1 << 53, "[0-9]{0,3}").prop_map(|(number, digits)| format!("{}.5{digits}", number | 1 << 52)),
        // One bit more than a double has, also behind the point.
        (1_u128 << 53..1 << 54, 0_u32..10)
            .prop_map(|(number, halvings)| format!("{}e-{halvings}", (number | 1) * 5_u128.pow(halvings))),
        (0_u64..1 << 12, 1..12_usize).prop_map(|(number, decimals)| format!("{number}.{:0>decimals$}", 5)),
    ]
}

/// A number as it is usually written into recordings.
fn usual() -> impl Strategy<Value = String> {
    let value = || prop_oneof![-1000.0..1000.0, -1.0..1.0, Just(0.0), Just(-0.0), Just(1.0)];
    prop_oneof![
        (value(), 0_usize..10).prop_map(|(value, decimals)| format!("{value:.decimals$}")),
        value()
            .prop_filter("written without an exponent", |value: &f64| value.abs() > 1e-3)
            .prop_map(|value| format!("{value}")),
        (1e-9..1e3, 3_usize..19).prop_map(|(value, decimals)| numpy(value, decimals)),
        (0_u64..2_000_000_000_000_000_000).prop_map(|stamp| stamp.to_string()),
    ]
}

/// As `numpy.savetxt` writes a number: its exponent has a sign and at least two digits.
fn numpy(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    let (digits, exponent) = text.split_once('e').unwrap();
    format!("{digits}e{:+03}", exponent.parse::<i32>().unwrap())
}

#[track_caller]
fn check(text: &str) {
    for following in FOLLOWING {
        let line = format!("{text}{following}");
        let Some(found) = leading_decimal(line.as_bytes()) else { continue };
        let read = &line[..found.length];
        assert_eq!(found.value.to_bits(), read.parse::<f64>().unwrap().to_bits(), "{read:?} of {line:?}");
        assert_eq!(found.next, line.as_bytes().get(found.length).copied(), "{line:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn a_decimal_is_what_the_standard_library_makes_of_it(text in decimal()) {
        check(&text);
    }

    #[test]
    fn a_quotient_is_what_the_standard_library_makes_of_it(number: u64, bits in 0_u32..64, power in 0_usize..30) {
        let number = number >> bits;
        let expected = format!("{number}e-{power}").parse::<f64>().unwrap();
        let found = nearest(number, power).unwrap_or(expected);
        prop_assert_eq!(found.to_bits(), expected.to_bits());
    }

    #[test]
    fn any_bytes_begin_with_a_number_or_not(bytes in proptest::collection::vec(any::<u8>(), 0..60)) {
        if let Some(found) = leading_decimal(&bytes) {
            let read = str::from_utf8(&bytes[..found.length]).unwrap();
            prop_assert_eq!(found.value.to_bits(), read.parse::<f64>().unwrap().to_bits());
        }
    }

    #[test]
    fn text_like_numbers_begins_with_a_number_or_not(text in "[0-9.eE+,-]{0,50}") {
        check(&text);
    }

    #[test]
    fn a_usual_number_is_read_at_once(text in usual()) {
        let line = format!("{text}{}", FOLLOWING[2]);
        let found = leading_decimal(line.as_bytes()).map(|found| (found.value.to_bits(), found.length));
        let expected = (text.parse::<f64>().unwrap().to_bits(), text.len());
        // A few quotients are too near to the middle of two doubles.
        prop_assert!(found == Some(expected) || found.is_none() && text.len() > 9, "{text:?}: {found:?}");
    }
}

#[test]
fn numbers_between_two_doubles_are_left_to_others() {
    assert_eq!(nearest((1 << 53) + 1, 0), None);
    assert_eq!(nearest(10 * ((1 << 53) + 1), 1), None);
    assert_eq!(nearest(1_000_000_000_000_000_000, 18), Some(1.0));
    assert_eq!(nearest(0, 20), Some(0.0));
    assert_eq!(nearest(1, 28), None);
}
