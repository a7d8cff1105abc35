//! Smooth motion in continuous time, sampled into frames.

use super::point::{Point, add, scale};

/// One smooth push: `offset` is covered from `start_s` on with no jerk at either end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    pub(super) start_s: f64,
    pub(super) duration_s: f64,
    pub(super) offset: Point,
}

impl Stroke {
    pub(super) fn end_s(&self) -> f64 {
        self.start_s + self.duration_s
    }

    fn covered(&self, time_s: f64) -> Point {
        let u = ((time_s - self.start_s) / self.duration_s).clamp(0.0, 1.0);
        scale(self.offset, u * u * u * (10.0 - 15.0 * u + 6.0 * u * u))
    }
}

/// Where every thing truly is in every frame so far.
pub(super) struct Tape {
    rate_hz: f64,
    time_s: f64,
    now: Vec<Point>,
    frames: Vec<Vec<Point>>,
}

impl Tape {
    pub(super) fn new(rate_hz: f64, starts: &[Point]) -> Self {
        Tape { rate_hz, time_s: 0.0, now: starts.to_vec(), frames: Vec::new() }
    }

    /// Where `thing` is now.
    pub(super) fn position(&self, thing: usize) -> Point {
        self.now[thing]
    }

    /// The next frame to be recorded.
    pub(super) fn next_frame(&self) -> usize {
        self.frames.len()
    }

    /// Nothing moves for a while.
    pub(super) fn wait(&mut self, duration_s: f64) {
        let end_s = self.time_s + duration_s;
        while self.next_time_s() < end_s {
            self.frames.push(self.now.clone());
        }
        self.time_s = end_s;
    }

    /// `thing` moves by the sum of `strokes` until the last of them ends.
    pub(super) fn play(&mut self, thing: usize, strokes: &[Stroke]) {
        let from = self.now[thing];
        let at = |time_s: f64| strokes.iter().fold(from, |point, stroke| add(point, stroke.covered(time_s)));
        let duration_s = strokes.iter().map(Stroke::end_s).fold(0.0, f64::max);
        while self.next_time_s() < self.time_s + duration_s {
            self.now[thing] = at(self.next_time_s() - self.time_s);
            self.frames.push(self.now.clone());
        }
        self.now[thing] = at(duration_s);
        self.time_s += duration_s;
    }

    /// Frames by things.
    pub(super) fn into_frames(self) -> Vec<Vec<Point>> {
        self.frames
    }

    fn next_time_s(&self) -> f64 {
        self.frames.len() as f64 / self.rate_hz
    }
}
