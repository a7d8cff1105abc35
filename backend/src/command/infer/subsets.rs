//! Feature subsets and their parameters, from `--subset`, `--epsilon` and `--min-points`.

use goalgraph::demonstration::Feature;
use goalgraph::subset::{Setting, SubsetRequest, propose_subsets};

use crate::failure::Failure;

/// A parameter as it is written: for every subset, or for the one it names.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ParameterOption<T> {
    subset: Option<String>,
    setting: Setting<T>,
}

/// Reads `red=red.x,red.y`.
pub(super) fn parse_subset(text: &str) -> Result<SubsetRequest, String> {
    let expected = || "expected a name and its features, such as red=red.x,red.y".to_owned();
    let (name, features) = text.split_once('=').ok_or_else(expected)?;
    let features: Vec<String> = features.split(',').map(|feature| feature.trim().to_owned()).collect();
    if name.is_empty() || features.iter().any(String::is_empty) {
        return Err(expected());
    }
    Ok(SubsetRequest { name: name.to_owned(), features, ..SubsetRequest::default() })
}

/// Reads `auto`, `0.01` or `red=0.01`.
pub(super) fn parse_epsilon(text: &str) -> Result<ParameterOption<f64>, String> {
    let number = |text: &str| text.parse().ok().filter(|epsilon: &f64| epsilon.is_finite() && *epsilon > 0.0);
    parse(text, number, "expected auto or a number above 0")
}

/// Reads `auto`, `20` or `red=20`.
pub(super) fn parse_min_points(text: &str) -> Result<ParameterOption<usize>, String> {
    let number = |text: &str| text.parse().ok().filter(|min_points| *min_points > 0);
    parse(text, number, "expected auto or a whole number of at least 1")
}

fn parse<T>(
    text: &str,
    number: impl Fn(&str) -> Option<T>,
    expected: &str,
) -> Result<ParameterOption<T>, String> {
    let (subset, value) = match text.rsplit_once('=') {
        Some((subset, value)) => (Some(subset.to_owned()), value),
        None => (None, text),
    };
    let setting = match value {
        "auto" => Setting::Auto,
        value => Setting::Fixed(number(value).ok_or(expected)?),
    };
    Ok(ParameterOption { subset, setting })
}

/// The published method chooses nothing itself.
///
/// # Errors
///
/// When a parameter has no number at all.
pub(super) fn refuse_automatic(
    epsilon: &[ParameterOption<f64>],
    min_points: &[ParameterOption<usize>],
) -> Result<(), Failure> {
    let has_number = epsilon.iter().any(|option| matches!(option.setting, Setting::Fixed(_)))
        && min_points.iter().any(|option| matches!(option.setting, Setting::Fixed(_)));
    if has_number { Ok(()) } else { Err(needs_numbers("")) }
}

fn needs_numbers(place: &str) -> Failure {
    let sentence = format!("error: --paper needs --epsilon and --min-points as numbers{place}");
    Failure::Usage(sentence)
}

/// The subsets to search with their parameters: `given`, or those proposed for `features` when none are given but a
/// parameter is set; empty when everything is left to the engine. A parameter for one subset comes before one for all,
/// a later one before an earlier one.
///
/// # Errors
///
/// When a parameter names a subset that is not there, or `all_fixed` and one is automatic.
pub(super) fn settle(
    given: &[SubsetRequest],
    features: &[Feature],
    epsilon: &[ParameterOption<f64>],
    min_points: &[ParameterOption<usize>],
    all_fixed: bool,
) -> Result<Vec<SubsetRequest>, Failure> {
    if given.is_empty() && epsilon.is_empty() && min_points.is_empty() {
        return Ok(Vec::new());
    }
    let mut subsets = if given.is_empty() { propose_subsets(features) } else { given.to_vec() };
    refuse_unknown("--epsilon", epsilon, &subsets)?;
    refuse_unknown("--min-points", min_points, &subsets)?;
    for subset in &mut subsets {
        subset.epsilon = setting_for(&subset.name, epsilon);
        subset.min_points = setting_for(&subset.name, min_points);
        if all_fixed && (subset.epsilon == Setting::Auto || subset.min_points == Setting::Auto) {
            return Err(needs_numbers(&format!(", also for subset {}", subset.name)));
        }
    }
    Ok(subsets)
}

fn setting_for<T: Copy>(subset: &str, options: &[ParameterOption<T>]) -> Setting<T> {
    let of = |wanted: Option<&str>| options.iter().rev().find(|option| option.subset.as_deref() == wanted);
    of(Some(subset)).or_else(|| of(None)).map_or(Setting::Auto, |option| option.setting)
}

fn refuse_unknown<T>(
    option_name: &str,
    options: &[ParameterOption<T>],
    subsets: &[SubsetRequest],
) -> Result<(), Failure> {
    for name in options.iter().filter_map(|option| option.subset.as_deref()) {
        if subsets.iter().all(|subset| subset.name != name) {
            let known: Vec<&str> = subsets.iter().map(|subset| subset.name.as_str()).collect();
            let known = known.join(", ");
            return Err(Failure::input(format!(
                "{option_name}: there is no subset {name:?}; there are: {known}"
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parameter_for_one_subset_comes_before_one_for_all() {
        let features = ["red.x", "red.y", "blue.x"].map(Feature::new);
        let epsilon = [parse_epsilon("red=0.5").unwrap(), parse_epsilon("0.25").unwrap()];
        let subsets = settle(&[], &features, &epsilon, &[], false).unwrap();
        let settled: Vec<_> = subsets.iter().map(|subset| (subset.name.as_str(), subset.epsilon)).collect();
        assert_eq!(settled, [("red", Setting::Fixed(0.5)), ("blue", Setting::Fixed(0.25))]);
        assert!(subsets.iter().all(|subset| subset.min_points == Setting::Auto));
    }

    #[test]
    fn a_parameter_of_an_unknown_subset_is_refused_with_the_known_ones() {
        let min_points = [parse_min_points("green=3").unwrap()];
        let failure =
            settle(&[], &["red.x", "red.y"].map(Feature::new), &[], &min_points, false).unwrap_err();
        assert_eq!(failure.lines(), ["--min-points: there is no subset \"green\"; there are: red"]);
    }

    #[test]
    fn what_is_no_parameter_is_refused() {
        for text in ["", "0", "-1", "inf", "nan", "red=", "x"] {
            assert!(parse_epsilon(text).is_err(), "{text}");
            assert!(parse_min_points(text).is_err(), "{text}");
        }
        for text in ["", "red", "=red.x", "red=", "red=a,,b"] {
            assert!(parse_subset(text).is_err(), "{text}");
        }
    }
}
