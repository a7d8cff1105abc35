//! Taking turns, medians of ratios, and growth.

use std::hint::black_box;
use std::time::Instant;

use anyhow::Result;

/// The middle of some measurements, and between what they lay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spread {
    pub(crate) median: f64,
    pub(crate) least: f64,
    pub(crate) most: f64,
}

impl Spread {
    /// Of at least one value.
    pub(crate) fn of(values: &[f64]) -> Self {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { median: median(values), least, most }
    }
}

/// The middle value, or the mean of the middle two; NaN of none.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => f64::NAN,
        length if length % 2 == 0 => f64::midpoint(values[middle - 1], values[middle]),
        _ => values[middle],
    }
}

/// Seconds that `work` takes. What it returns is dropped after the clock has stopped.
pub(crate) fn seconds<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    let result = black_box(work());
    let seconds = start.elapsed().as_secs_f64();
    drop(result);
    seconds
}

/// One side of a comparison: does its work once and tells the seconds that it took.
pub(crate) type Side<'a> = &'a mut dyn FnMut() -> Result<f64>;

/// The seconds of each side, turn by turn.
pub(crate) struct Turns<const SIDES: usize>(Vec<[f64; SIDES]>);

/// How long the turns of one comparison may take in all, and how many there are at least and at most.
const LONG_ENOUGH_S: f64 = 12.0;
const FEWEST_TURNS: usize = 3;
const MOST_TURNS: usize = 9;

/// Lets the sides take turns until the ratios are worth having. A first turn that is quick is a rehearsal: pages, caches and
/// the processor's clock are then ready.
///
/// # Errors
///
/// The first of a side.
pub(crate) fn take_turns<const SIDES: usize>(mut sides: [Side; SIDES]) -> Result<Turns<SIDES>> {
    let started = Instant::now();
    let mut turns = vec![turn(&mut sides)?];
    if turns[0].iter().sum::<f64>() < 1.0 {
        turns.clear();
    }
    while turns.len() < FEWEST_TURNS
        || (turns.len() < MOST_TURNS && started.elapsed().as_secs_f64() < LONG_ENOUGH_S)
    {
        turns.push(turn(&mut sides)?);
    }
    Ok(Turns(turns))
}

fn turn<const SIDES: usize>(sides: &mut [Side; SIDES]) -> Result<[f64; SIDES]> {
    let mut seconds = [0.0; SIDES];
    for (seconds, side) in seconds.iter_mut().zip(sides) {
        *seconds = side()?;
    }
    Ok(seconds)
}

impl<const SIDES: usize> Turns<SIDES> {
    /// How many times as long side `a` took as side `b`.
    pub(crate) fn ratio(&self, a: usize, b: usize) -> Spread {
        Spread::of(&self.0.iter().map(|turn| turn[a] / turn[b]).collect::<Vec<_>>())
    }

    /// The median of the seconds of a side.
    pub(crate) fn seconds(&self, side: usize) -> f64 {
        median(&self.0.iter().map(|turn| turn[side]).collect::<Vec<_>>())
    }
}

/// The growth exponent `b` of `cost = a · size^b`, fitted by least squares to the logarithms; NaN of fewer than two
/// sizes.
pub(crate) fn exponent(costs: &[(usize, f64)]) -> f64 {
    let logarithms: Vec<(f64, f64)> =
        costs.iter().map(|&(size, cost)| ((size as f64).ln(), cost.ln())).collect();
    let count = logarithms.len() as f64;
    let mean_x = logarithms.iter().map(|(x, _)| x).sum::<f64>() / count;
    let mean_y = logarithms.iter().map(|(_, y)| y).sum::<f64>() / count;
    let covariance: f64 = logarithms.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = logarithms.iter().map(|(x, _)| (x - mean_x) * (x - mean_x)).sum();
    covariance / variance
}

/// Bytes that the system can still give away, where it says so.
pub(crate) fn available_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().trim_end_matches("kB").trim().parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
}

/// A pool of so many threads of rayon.
///
/// # Errors
///
/// When the threads cannot be started.
pub(crate) fn threads(count: usize) -> Result<rayon::ThreadPool> {
    Ok(rayon::ThreadPoolBuilder::new().num_threads(count).build()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_or_between_the_middle_two() {
        let medians = vec![median(&[3.0, 1.0, 2.0]), median(&[4.0, 1.0, 2.0, 3.0])];
        assert_eq!(medians, [2.0, 2.5]);
        assert!(median(&[]).is_nan());
        assert_eq!(Spread::of(&[3.0, 1.0, 8.0]), Spread { median: 3.0, least: 1.0, most: 8.0 });
    }

    #[test]
    fn the_exponent_of_a_power_is_found() {
        let power = |b: f64| [10_usize, 100, 1000].map(|size| (size, 7.0 * (size as f64).powf(b)));
        for b in [0.0, 1.0, 1.1, 2.0] {
            assert!((exponent(&power(b)) - b).abs() < 1e-12);
        }
        assert!(exponent(&[(10, 1.0)]).is_nan());
    }

    #[test]
    fn one_size_that_is_off_moves_the_exponent_as_least_squares_do() {
        // Steps of one decade, costs 1, 10, 1000: slopes 1 and 2 weigh the same.
        let fitted = exponent(&[(10, 1.0), (100, 10.0), (1000, 1000.0)]);
        assert!((fitted - 1.5).abs() < 1e-12, "{fitted}");
    }

    #[test]
    fn a_ratio_is_that_of_one_turn_and_not_of_medians() {
        let turns = Turns(vec![[10.0, 1.0], [2.0, 1.0], [30.0, 10.0]]);
        assert_eq!(turns.ratio(0, 1), Spread { median: 3.0, least: 2.0, most: 10.0 });
        assert_eq!(vec![turns.seconds(0), turns.seconds(1)], [10.0, 1.0]);
    }

    #[test]
    fn sides_take_turns() {
        let order = std::cell::RefCell::new(String::new());
        let side = |name: char, seconds: f64| {
            let order = &order;
            move || {
                order.borrow_mut().push(name);
                Ok(seconds)
            }
        };
        let turns = take_turns([&mut side('a', 1.0), &mut side('b', 2.0)]).unwrap();
        assert_eq!(turns.ratio(1, 0), Spread { median: 2.0, least: 2.0, most: 2.0 });
        assert_eq!(*order.borrow(), "ab".repeat(MOST_TURNS));
    }
}
