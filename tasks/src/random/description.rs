//! What was drawn, in one line.

use crate::layout::Layout;

use super::knobs::Knobs;

impl Knobs {
    /// One line that tells what was drawn; read radians for metres where an arm moves.
    pub(crate) fn description(&self, seed: u64, layout: &Layout) -> String {
        let (manner, sensing, notation) = (&self.manner, &self.sensing, &self.notation);
        let (hesitation, timing) = (&manner.hesitation, &manner.timing);
        format!(
            "seed {seed}: {:?}, {} objects, {} places at least {:.1} mm apart, {} orders, {} demonstrations, starts {}; \
             {:?} at {} Hz, {} axes; {:?} {:?} at {:.2}..{:.2} m/s, lift {:.0} mm, jitter {:.1} mm, pass {:.2}; \
             hover {:.1} s at pick, {:.1} s at place, tremor {:.1} mm, pause {:.2}, approach {:.3} m/s in {} steps; \
             lead {:.1} s, dwell {:.1}..{:.1} s, tail {:.1}..{:.1} s; \
             noise {:.1} mm, wild {:.2} %, {:.2} occlusions/s up to {:.1} s",
            self.kind,
            layout.objects.len(),
            layout.sites.len(),
            self.separation * 1e3,
            layout.orders.len(),
            self.demonstrations,
            if self.starts_vary { "vary" } else { "fixed" },
            notation.unit,
            manner.rate_hz,
            notation.axes.len(),
            manner.route,
            manner.profile,
            manner.speed.0,
            manner.speed.1,
            manner.lift * 1e3,
            manner.jitter * 1e3,
            manner.pass_probability,
            hesitation.hover_at_pick.1,
            hesitation.hover_at_place.1,
            hesitation.tremor * 1e3,
            hesitation.pause_probability,
            hesitation.approach_speed,
            hesitation.approach_steps,
            timing.lead.1,
            timing.dwell.0,
            timing.dwell.1,
            timing.tail.0,
            timing.tail.1,
            sensing.noise * 1e3,
            sensing.wild_probability * 1e2,
            sensing.occlusions_per_second,
            sensing.longest_occlusion,
        )
    }
}
