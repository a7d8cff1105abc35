//! The stage on which an order is acted out: what is where, frame after frame.

use crate::chance::Chance;
use crate::geometry::{Path, Point, add, nearest, raised};
use crate::layout::{Layout, Object};
use crate::manner::{Manner, SHORTEST_REST};
use crate::motion::{Profile, tremor};
use crate::perform::Performance;
use crate::task::Rest;

pub(crate) struct Stage<'a> {
    pub(crate) layout: &'a Layout,
    pub(crate) manner: &'a Manner,
    pub(crate) chance: &'a mut Chance,
    /// Where each object is.
    pub(crate) now: Vec<Point>,
    frames: Vec<Vec<Point>>,
    rests: Vec<Rest>,
}

impl<'a> Stage<'a> {
    pub(crate) fn new(layout: &'a Layout, manner: &'a Manner, chance: &'a mut Chance) -> Self {
        let mut stage =
            Self { layout, manner, chance, now: Vec::new(), frames: Vec::new(), rests: Vec::new() };
        for (index, object) in layout.objects.iter().enumerate() {
            let start = stage.start(index, object);
            stage.now.push(start);
        }
        stage
    }

    /// Somewhere in the start region, but clear of the object's own places.
    fn start(&mut self, index: usize, object: &Object) -> Point {
        let reach = object.start_reach.max(self.manner.jitter);
        let keep_off = 2.0 * self.manner.clearance;
        for _ in 0..50 {
            let start = add(object.start, self.offset(reach));
            if nearest(start, self.layout.centers(index)) >= keep_off {
                return start;
            }
        }
        object.start
    }

    pub(crate) fn travel(&mut self, object: usize, path: &Path) {
        let speed = self.chance.within(self.manner.speed);
        self.travel_at(object, path, speed, self.manner.profile);
    }

    pub(crate) fn travel_at(&mut self, object: usize, path: &Path, speed: f64, profile: Profile) {
        let duration = path.length() / speed;
        let frames = ((duration * self.manner.rate_hz).round() as usize).max(1);
        for frame in 1..=frames {
            self.now[object] = path.at(profile.progress(frame as f64 / frames as f64));
            self.frames.push(self.now.clone());
        }
    }

    /// Holds an object still in the air, as still as the hand can.
    pub(crate) fn hover(&mut self, object: usize, duration: (f64, f64)) {
        let center = self.now[object];
        let frames = (self.chance.within(duration) * self.manner.rate_hz).round() as usize;
        let amplitude = self.manner.hesitation.tremor;
        for offset in tremor(frames, self.manner.rate_hz, amplitude, self.chance) {
            self.now[object] = add(center, offset);
            self.frames.push(self.now.clone());
        }
    }

    pub(crate) fn rest(&mut self, (least, most): (f64, f64)) {
        let (seconds, frames) = SHORTEST_REST;
        let floor = seconds.max(frames as f64 / self.manner.rate_hz);
        self.stand_still((least.max(floor), most.max(floor)));
    }

    pub(crate) fn stand_still(&mut self, duration: (f64, f64)) {
        let frames = (self.chance.within(duration) * self.manner.rate_hz).ceil() as usize;
        for _ in 0..frames.max(2) {
            self.frames.push(self.now.clone());
        }
    }

    /// The site's object has just come to rest there.
    pub(crate) fn begin_rest(&mut self, site: usize) {
        self.rests.push(Rest { place: site, frames: self.frames.len() - 1..usize::MAX });
    }

    /// The object is about to move.
    pub(crate) fn end_rest(&mut self, object: usize) {
        let now = self.frames.len();
        for rest in &mut self.rests {
            if self.layout.sites[rest.place].object == object {
                rest.frames.end = rest.frames.end.min(now);
            }
        }
    }

    /// As high above the point as things are lifted, or higher where a place is near.
    pub(crate) fn above(&self, object: usize, point: Point) -> Point {
        let mut above = raised(point, self.manner.lift);
        while !self.is_clear(object, above) {
            above = raised(above, self.manner.clearance / 2.0);
        }
        above
    }

    pub(crate) fn is_clear(&self, object: usize, point: Point) -> bool {
        nearest(point, self.layout.centers(object)) >= self.manner.clearance
    }

    /// A random offset along each axis; the table keeps things on it from being off along z.
    pub(crate) fn offset(&mut self, reach: f64) -> Point {
        let reach_up = if self.manner.is_airborne { reach } else { 0.0 };
        [reach, reach, reach_up].map(|reach| self.chance.within((-reach, reach)))
    }

    pub(crate) fn finish(mut self) -> Performance {
        let end = self.frames.len();
        for rest in &mut self.rests {
            rest.frames.end = rest.frames.end.min(end);
        }
        Performance { frames: self.frames, rests: self.rests }
    }
}
