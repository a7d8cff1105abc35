//! A robot without a body: things move in straight lines at one speed.

use std::collections::BTreeMap;

use goalgraph::pdfa::Symbol;
use goalgraph::specification::{Ball, Specification, SubGoal};

/// How long a sub-goal takes that has no place, in seconds.
const SECONDS_WITHOUT_PLACE: f64 = 1.0;

/// How far from every place things are at first where all places are in one point, in the unit of the features.
const SMALLEST_MARGIN: f64 = 0.1;

/// A kinematic robot: the value of every feature, and how fast it changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    scene: BTreeMap<String, f64>,
    speed: f64,
    /// What it works on, and for how many seconds.
    at_work: Option<(Symbol, f64)>,
}

impl Robot {
    /// A robot in front of a scene in which no sub-goal is reached yet; `speed` in units of the features a second.
    pub fn new(specification: &Specification, speed: f64) -> Self {
        let mut scene = BTreeMap::new();
        let balls: Vec<&Ball> = specification.sub_goals.iter().filter_map(|it| it.ball.as_ref()).collect();
        for feature in balls.iter().flat_map(|ball| &ball.features) {
            scene.entry(feature.clone()).or_insert_with(|| before_all(&balls, feature));
        }
        Self { scene, speed, at_work: None }
    }

    /// Works on a sub-goal for some seconds; whether it is reached then.
    ///
    /// The features of its subset move together towards the center. What has no place takes one second.
    pub fn work(&mut self, sub_goal: &SubGoal, seconds: f64) -> bool {
        let before =
            self.at_work.filter(|(symbol, _)| *symbol == sub_goal.id).map_or(0.0, |(_, worked)| worked);
        let worked = before + seconds;
        let reached = match &sub_goal.ball {
            Some(ball) => self.approach(ball, self.speed * seconds),
            None => worked >= SECONDS_WITHOUT_PLACE,
        };
        self.at_work = Some((sub_goal.id, worked)).filter(|_| !reached);
        reached
    }

    /// Where the features are, in their order; NaN for one that the scene does not have.
    pub fn point(&self, features: &[String]) -> Vec<f64> {
        features.iter().map(|feature| self.scene.get(feature).copied().unwrap_or(f64::NAN)).collect()
    }

    fn approach(&mut self, ball: &Ball, step: f64) -> bool {
        let point = self.point(&ball.features);
        let way: Vec<f64> = ball.center.iter().zip(&point).map(|(center, from)| center - from).collect();
        let distance = way.iter().map(|part| part * part).sum::<f64>().sqrt();
        let arrives = distance <= step;
        for (index, feature) in ball.features.iter().enumerate() {
            let to = if arrives { ball.center[index] } else { point[index] + way[index] * step / distance };
            self.scene.insert(feature.clone(), to);
        }
        arrives && ball.contains(&self.point(&ball.features))
    }
}

/// A value of the feature below all places, as far from them as they are spread, and well out of their balls.
fn before_all(balls: &[&Ball], feature: &str) -> f64 {
    let mut low = f64::INFINITY;
    let mut high = f64::NEG_INFINITY;
    let mut radius: f64 = 0.0;
    for ball in balls {
        for (_, &center) in ball.features.iter().zip(&ball.center).filter(|(name, _)| *name == feature) {
            low = low.min(center);
            high = high.max(center);
            radius = radius.max(ball.radius);
        }
    }
    let margin = (high - low).max(4.0 * radius);
    low - if margin > 0.0 { margin } else { SMALLEST_MARGIN }
}

#[cfg(test)]
mod tests {
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;

    use super::*;

    fn specification(centers: &[[f64; 2]]) -> Specification {
        let word = (0..centers.len()).map(|index| format!("place {index}")).collect::<Vec<_>>();
        let mut specification = infer_words("", Semantics::default(), &[word]);
        for (sub_goal, center) in specification.sub_goals.iter_mut().zip(centers) {
            let features = vec!["red.x".to_owned(), "red.y".to_owned()];
            let subset = "red".to_owned();
            sub_goal.ball = Some(Ball { subset, features, center: center.to_vec(), radius: 0.01 });
        }
        specification
    }

    #[test]
    fn a_thing_starts_in_no_place_and_arrives_after_its_way_at_its_speed() {
        let specification = specification(&[[0.2, 0.4], [0.5, 0.0]]);
        let mut robot = Robot::new(&specification, 0.5);
        for sub_goal in &specification.sub_goals {
            let ball = sub_goal.ball.as_ref().unwrap();
            let point = robot.point(&ball.features);
            assert!(!ball.contains(&point));
            let way: f64 = ball.center.iter().zip(&point).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
            let steps = (1..100_000_u32).find(|_| robot.work(sub_goal, 0.02)).unwrap();
            assert_eq!(steps, (way / (0.5 * 0.02)).ceil() as u32);
            assert_eq!(robot.point(&ball.features), ball.center);
        }
    }

    #[test]
    fn a_sub_goal_without_a_place_takes_a_second_of_undivided_work() {
        let specification = infer_words("", Semantics::default(), &[vec!["a".to_owned(), "b".to_owned()]]);
        let [a, b] = &specification.sub_goals[..] else { panic!("two sub-goals") };
        let mut robot = Robot::new(&specification, 1.0);
        assert!(!robot.work(a, 0.75));
        assert!(!robot.work(b, 0.75));
        assert!(!robot.work(a, 0.75));
        assert!(robot.work(a, 0.25));
    }
}
