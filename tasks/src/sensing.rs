//! What a camera makes of the truth: noise, wild detections, occlusion.

use std::ops::Range;

use crate::chance::Chance;
use crate::geometry::{Point, add, distance, nearest};
use crate::layout::Layout;
use crate::manner::SHORTEST_REST;
use crate::perform::Performance;

/// Lengths in metres (radians for an arm).
#[derive(Clone, Debug)]
pub(crate) struct Sensing {
    /// Standard deviation along each axis.
    pub(crate) noise: f64,
    /// Probability that one frame shows an object far from where it is.
    pub(crate) wild_probability: f64,
    /// How far off a wild detection is at most.
    pub(crate) wild_reach: f64,
    /// No wild detection is closer to a place of its object.
    pub(crate) wild_clearance: f64,
    /// How often an object gets out of sight, per second.
    pub(crate) occlusions_per_second: f64,
    /// For how long it then does at most, in seconds.
    pub(crate) longest_occlusion: f64,
}

/// What was seen: frames by objects; `None` where an object was not detected.
pub(crate) type Sightings = Vec<Vec<Option<Point>>>;

/// Looks at a performance.
///
/// Of each stay (before the first move, or at a place until the next thing is placed) a handful of frames is always
/// seen, and seen where the object is: so the order of placing remains observable.
pub(crate) fn sense(
    performance: &Performance,
    layout: &Layout,
    sensing: &Sensing,
    rate_hz: f64,
    chance: &mut Chance,
) -> Sightings {
    let frames = &performance.frames;
    let mut seen = with_noise(frames, sensing.noise, chance);
    for object in 0..layout.objects.len() {
        let mut witness = Witness::new(performance, layout, object, rate_hz);
        for frame in 0..frames.len() {
            if chance.happens(sensing.occlusions_per_second / rate_hz) {
                let duration = chance.within((0.0, sensing.longest_occlusion));
                let end = frame + (duration * rate_hz) as usize + 1;
                let hidden = frame..end.min(frames.len());
                if witness.can_miss(hidden.clone()) {
                    seen[hidden].iter_mut().for_each(|row| row[object] = None);
                }
            }
            if chance.happens(sensing.wild_probability) {
                let wild = wild_detection(frames[frame][object], layout, object, sensing, chance);
                if wild.is_some() && witness.can_miss(frame..frame + 1) {
                    seen[frame][object] = wild;
                }
            }
        }
    }
    seen
}

fn with_noise(frames: &[Vec<Point>], noise: f64, chance: &mut Chance) -> Sightings {
    let mut blur = |point: &Point| Some(point.map(|value| value + noise * chance.gaussian()));
    let rows = frames.iter();
    rows.map(|row| row.iter().map(&mut blur).collect()).collect()
}

fn wild_detection(
    truth: Point,
    layout: &Layout,
    object: usize,
    sensing: &Sensing,
    chance: &mut Chance,
) -> Option<Point> {
    let reach = sensing.wild_reach;
    let offset = [reach, reach, reach / 4.0].map(|reach| chance.within((-reach, reach)));
    let wild = add(truth, offset);
    let flat = |point: Point| [point[0], point[1], 0.0];
    let taken = layout.centers(object).chain([truth]).map(flat);
    (nearest(flat(wild), taken) >= sensing.wild_clearance).then_some(wild)
}

/// Keeps count of how much of each stay of one object is seen.
struct Witness {
    stays: Vec<Range<usize>>,
    is_seen: Vec<bool>,
    handful: usize,
}

impl Witness {
    fn new(performance: &Performance, layout: &Layout, object: usize, rate_hz: f64) -> Self {
        let end = performance.frames.len();
        let rests = &performance.rests;
        let arrivals = rests.iter().map(|rest| rest.frames.start);
        let next_arrivals = arrivals.skip(1).chain([end]);
        let is_own = |place: usize| layout.sites[place].object == object;
        let mut stays: Vec<Range<usize>> = rests
            .iter()
            .zip(next_arrivals)
            .filter(|(rest, _)| is_own(rest.place))
            .map(|(rest, next)| rest.frames.start..rest.frames.end.min(next))
            .collect();
        let start = performance.frames[0][object];
        let has_moved = |row: &Vec<Point>| distance(row[object], start) > 0.0;
        let first_move = performance.frames.iter().position(has_moved);
        stays.push(0..first_move.unwrap_or(end));
        let (seconds, frames) = SHORTEST_REST;
        let handful = frames.max((seconds * rate_hz * 0.6) as usize);
        Self { stays, is_seen: vec![true; end], handful }
    }

    /// Whether enough is seen without these frames; if so, they no longer count as seen.
    fn can_miss(&mut self, frames: Range<usize>) -> bool {
        let is_enough = self.stays.iter().all(|stay| {
            let without = |&frame: &usize| self.is_seen[frame] && !frames.contains(&frame);
            let left = stay.clone().filter(without).count();
            let is_touched = stay.start < frames.end && frames.start < stay.end;
            !is_touched || left >= self.handful
        });
        if is_enough {
            self.is_seen[frames].fill(false);
        }
        is_enough
    }
}
