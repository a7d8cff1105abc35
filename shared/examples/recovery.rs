//! How many generated tasks come out exactly: by our method, by one fixed setting, and by the textbook knee rule.
//!
//! ```text
//! cargo run --release -p goalgraph --example recovery -- [FROM TO]
//! ```
//!
//! Per generator the seeds FROM..TO (0..200 when not given) are split by kind of task. The two baselines cluster every
//! frame and take the largest radius, as published.

#[path = "../tests/recovery/truth.rs"]
mod truth;

use std::collections::BTreeMap;
use std::error::Error;
use std::ops::Range;

use goalgraph::demonstration::{Demonstration, Feature};
use goalgraph::infer::{InferRequest, Inference, Method, RadiusRule, infer};
use goalgraph::points::{Track, squared_distance};
use goalgraph::subset::{Setting, SubsetRequest, propose_subsets};
use goalgraph_tasks::{
    Task, Unit, arm, drone, four_blocks, four_places, held_out_task, random_task, rebuilt_stack, tower,
    two_stacks,
};
use truth::{demonstrations, difference};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// How many tasks there are of a kind, and how many of them each method recovers.
#[derive(Clone, Copy, Default)]
struct Share {
    ours: usize,
    fixed: usize,
    knee: usize,
    tasks: usize,
}

impl Share {
    fn add(&mut self, other: Self) {
        self.ours += other.ours;
        self.fixed += other.fixed;
        self.knee += other.knee;
        self.tasks += other.tasks;
    }

    fn print(self, generator: &str, kind: &str) {
        let Self { ours, fixed, knee, tasks } = self;
        println!("{generator:<10} {kind:<18} {tasks:>6} {ours:>6} {fixed:>6} {knee:>6}");
    }
}

fn main() -> Result<()> {
    let numbers =
        std::env::args().skip(1).map(|text| text.parse()).collect::<std::result::Result<Vec<u64>, _>>()?;
    let seeds = match numbers[..] {
        [] => 0..200,
        [from, to] => from..to,
        _ => return Err("expected: recovery [FROM TO]".into()),
    };
    println!("{:<10} {:<18} {:>6} {:>6} {:>6} {:>6}", "generator", "kind", "tasks", "ours", "fixed", "knee");
    print_shares("named", named_task, seeds.clone())?;
    print_shares("random", random_task, seeds.clone())?;
    print_shares("held-out", held_out_task, seeds)
}

fn print_shares(generator: &str, generate: fn(u64) -> Task, seeds: Range<u64>) -> Result<()> {
    let mut shares: BTreeMap<String, Share> = BTreeMap::new();
    let mut all = Share::default();
    for seed in seeds {
        let task = generate(seed);
        let share = share(&task)?;
        shares.entry(kind(&task)).or_default().add(share);
        all.add(share);
    }
    for (kind, share) in shares {
        share.print(generator, &kind);
    }
    all.print(generator, "all");
    Ok(())
}

/// The tasks that everybody knows, in turn.
fn named_task(seed: u64) -> Task {
    match seed % 7 {
        0 => tower(seed, 9),
        1 => two_stacks(seed, 18),
        2 => four_blocks(seed, 24),
        3 => four_places(seed, 12),
        4 => drone(seed, 10),
        5 => arm(seed, 10),
        _ => rebuilt_stack(2, seed, 9),
    }
}

/// The first word of what was drawn, `seed 7: Drone, 1 objects, ..`; the name of a task where nothing is drawn.
fn kind(task: &Task) -> String {
    let drawn = task.description.strip_prefix("seed ").and_then(|text| text.split_once(": "));
    let kind = drawn.map_or(task.name.as_str(), |(_, drawn)| drawn.split(',').next().unwrap_or(drawn));
    kind.to_owned()
}

fn share(task: &Task) -> Result<Share> {
    let demonstrations = demonstrations(task)?;
    let count = |request: &InferRequest| -> Result<usize> {
        let inference: Inference = infer(&demonstrations, request, &mut |_| {})?;
        Ok(usize::from(difference(task, &inference).is_none()))
    };
    Ok(Share {
        ours: count(&InferRequest::default())?,
        fixed: count(&published(&demonstrations, |_, _| fixed_setting(task.unit)))?,
        knee: count(&published(&demonstrations, knee_rule))?,
        tasks: 1,
    })
}

/// The method as published, with the `epsilon` and `min_points` that `choose` gives for a subset.
fn published(
    demonstrations: &[Demonstration],
    choose: impl Fn(&[Demonstration], &SubsetRequest) -> (f64, usize),
) -> InferRequest {
    let features: &[Feature] = demonstrations[0].features();
    let mut subsets = propose_subsets(features);
    for subset in &mut subsets {
        let (epsilon, min_points) = choose(demonstrations, subset);
        (subset.epsilon, subset.min_points) = (Setting::Fixed(epsilon), Setting::Fixed(min_points));
    }
    InferRequest {
        subsets,
        method: Method::Published,
        radius: RadiusRule::Largest,
        ..InferRequest::default()
    }
}

/// A centimeter (or a hundredth of a radian), ten points.
fn fixed_setting(unit: Unit) -> (f64, usize) {
    (0.01 * unit.per_base(), 10)
}

/// Each point's distance to the `min_points`-th nearest (itself included), sorted, and epsilon at the point of the curve
/// that is furthest from its chord.
fn knee_rule(demonstrations: &[Demonstration], subset: &SubsetRequest) -> (f64, usize) {
    let min_points = 2 * subset.features.len();
    let points = points(demonstrations, subset);
    let mut curve: Vec<f64> =
        sample(&points).map(|point| distance_to_nth(point, &points, min_points)).collect();
    curve.sort_by(f64::total_cmp);
    (knee(&curve).max(1e-6), min_points)
}

fn points(demonstrations: &[Demonstration], subset: &SubsetRequest) -> Vec<Vec<f64>> {
    let tracks = demonstrations.iter().map(|demonstration| {
        let columns = subset.features.iter().filter_map(|name| demonstration.feature_index(name));
        Track::new(demonstration, &columns.collect::<Vec<_>>())
    });
    tracks.flat_map(|track| track.points.iter().map(<[f64]>::to_vec).collect::<Vec<_>>()).collect()
}

/// A few hundred of the points are enough to draw the curve; the neighbors are looked for among all.
fn sample(points: &[Vec<f64>]) -> impl Iterator<Item = &Vec<f64>> {
    points.iter().step_by((points.len() / 400).max(1))
}

fn distance_to_nth(point: &[f64], points: &[Vec<f64>], nth: usize) -> f64 {
    let mut squares: Vec<f64> = points.iter().map(|other| squared_distance(point, other)).collect();
    let at = (nth - 1).min(squares.len() - 1);
    squares.select_nth_unstable_by(at, f64::total_cmp).1.sqrt()
}

/// The value of an ascending curve where it is furthest below its chord; zero when there is none.
fn knee(curve: &[f64]) -> f64 {
    let (Some(first), Some(last)) = (curve.first(), curve.last()) else {
        return 0.0;
    };
    let slope = (last - first) / (curve.len() as f64 - 1.0).max(1.0);
    let below = |index: usize| first + slope * index as f64 - curve[index];
    let furthest = (0..curve.len()).max_by(|&a, &b| below(a).total_cmp(&below(b)));
    furthest.map_or(0.0, |index| curve[index])
}
