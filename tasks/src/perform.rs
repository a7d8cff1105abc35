//! Acting out one order of placing.

use crate::chance::Chance;
use crate::geometry::{Path, Point, add, nearest};
use crate::layout::Layout;
use crate::manner::{Manner, Route};
use crate::motion::Profile;
use crate::stage::Stage;
use crate::task::Rest;

/// Where everything truly was.
pub(crate) struct Performance {
    /// Frames by objects.
    pub(crate) frames: Vec<Vec<Point>>,
    /// In the order of the word.
    pub(crate) rests: Vec<Rest>,
}

/// Acts out the word, whose symbols are indices of the layout's sites.
pub(crate) fn perform(layout: &Layout, word: &[usize], manner: &Manner, chance: &mut Chance) -> Performance {
    let mut stage = Stage::new(layout, manner, chance);
    stage.stand_still(manner.timing.lead);
    for (index, &site) in word.iter().enumerate() {
        stage.place(site);
        let is_last = index + 1 == word.len();
        let timing = &manner.timing;
        stage.rest(if is_last { timing.tail } else { timing.dwell });
    }
    stage.finish()
}

impl Stage<'_> {
    /// Moves the site's object there, by the route of this manner.
    fn place(&mut self, site: usize) {
        let object = self.layout.sites[site].object;
        let missed_by = self.offset(self.manner.jitter);
        let goal = add(self.layout.sites[site].center, missed_by);
        self.end_rest(object);
        let from = self.now[object];
        if let Some(via) = self.place_on_the_way(object, goal) {
            self.pass_through(object, via, goal);
        } else {
            match self.manner.route {
                Route::Straight => self.approach(object, &Path::through(&[from, goal])),
                Route::Arc => self.approach(object, &self.arc(from, goal)),
                Route::Bridge => {
                    let (up, above) = (self.above(object, from), self.above(object, goal));
                    self.approach(object, &Path::through(&[from, up, above, goal]));
                }
                Route::Lift => self.lift_over(object, goal),
            }
        }
        self.begin_rest(site);
    }

    /// Up, hover, across, hover, down in steps.
    fn lift_over(&mut self, object: usize, goal: Point) {
        let hesitation = self.manner.hesitation.clone();
        let (from, above) = (self.now[object], self.above(object, goal));
        let up = self.above(object, from);
        self.travel(object, &Path::through(&[from, up]));
        self.hover(object, hesitation.hover_at_pick);
        self.travel_with_pause(object, &Path::through(&[up, above]));
        self.hover(object, hesitation.hover_at_place);
        self.lower(object, &Path::through(&[above, goal]));
    }

    /// Down in steps, but without a stop where a place is near.
    fn lower(&mut self, object: usize, way_down: &Path) {
        let hesitation = &self.manner.hesitation;
        let (speed, steps) = (hesitation.approach_speed, hesitation.approach_steps);
        for step in 1..=steps {
            let next = way_down.at(step as f64 / steps as f64);
            let is_stop = self.is_clear(object, next);
            if is_stop || step == steps {
                let leg = Path::through(&[self.now[object], next]);
                self.travel_at(object, &leg, speed, self.manner.profile);
            }
            if is_stop {
                self.hover(object, (0.1, 0.3));
            }
        }
    }

    /// The whole way, the last bit of it slowly.
    fn approach(&mut self, object: usize, path: &Path) {
        let hesitation = &self.manner.hesitation;
        let speed = hesitation.approach_speed;
        let slow_share = (hesitation.approach_length / path.length()).min(0.5);
        let turning = path.at(1.0 - slow_share);
        let goal = path.at(1.0);
        self.travel_with_pause(object, &path.until(1.0 - slow_share));
        if slow_share > 0.0 {
            let rest_of_way = Path::through(&[turning, goal]);
            self.travel_at(object, &rest_of_way, speed, Profile::ConstantSpeed);
        }
    }

    /// Fast and without a halt, so that nobody takes it for a rest.
    fn pass_through(&mut self, object: usize, via: Point, goal: Point) {
        let path = Path::through(&[self.now[object], via, goal]);
        let speed = self.manner.speed.1;
        self.travel_at(object, &path, speed, Profile::ConstantSpeed);
    }

    fn place_on_the_way(&mut self, object: usize, goal: Point) -> Option<Point> {
        if !self.chance.happens(self.manner.pass_probability) {
            return None;
        }
        let ends = [self.now[object], goal];
        let others: Vec<Point> = self
            .layout
            .centers(object)
            .filter(|&center| nearest(center, ends) >= self.manner.clearance)
            .collect();
        (!others.is_empty()).then(|| self.chance.pick(&others))
    }

    fn travel_with_pause(&mut self, object: usize, path: &Path) {
        let share = self.chance.within((0.3, 0.7));
        let pauses = self.chance.happens(self.manner.hesitation.pause_probability);
        if pauses && self.is_clear(object, path.at(share)) {
            self.travel(object, &path.until(share));
            self.hover(object, (0.1, 0.4));
            self.travel(object, &path.from(share));
        } else {
            self.travel(object, path);
        }
    }

    fn arc(&self, from: Point, goal: Point) -> Path {
        let lift = self.manner.lift;
        let bulge = if self.manner.is_airborne { [lift, -lift, 0.0] } else { [0.0, 0.0, lift] };
        Path::arc(from, goal, bulge)
    }
}
