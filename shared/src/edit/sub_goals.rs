//! Making two sub-goals one, and removing one.

use super::alphabet::{known, sub_goal};
use super::reread::reread;
use super::{EditError, Folded};
use crate::pdfa::{StateId, Symbol};
use crate::points::distance;
use crate::specification::{Ball, Specification};

/// Makes `merged` part of `kept`.
pub(super) fn merge(
    specification: &mut Specification,
    kept: Symbol,
    merged: Symbol,
    first_new: StateId,
) -> Result<Folded, EditError> {
    known(specification, kept)?;
    let gone = sub_goal(specification, merged)?.clone();
    if kept == merged {
        return Err(EditError::SameSubGoal(kept));
    }
    let stays = sub_goal(specification, kept)?;
    stays.ball = match (stays.ball.take(), gone.ball) {
        (Some(one), Some(other)) if one.subset != other.subset => {
            return Err(EditError::DifferentSubsets(kept, merged));
        }
        (Some(one), Some(other)) => Some(enclosing(one, other).ok_or(EditError::TooFarApart(kept, merged))?),
        (one, other) => one.or(other),
    };
    stays.frames = stays.frames.saturating_add(gone.frames);
    stays.color = stays.color.or(gone.color);
    specification.sub_goals.retain(|sub_goal| sub_goal.id != merged);
    let projection = |symbol| Some(if symbol == merged { kept } else { symbol });
    let folded = reread(specification, &projection, Some(kept), first_new)?;
    let reached = specification.demonstrations.iter().filter(|shown| shown.word.contains(&kept)).count();
    sub_goal(specification, kept)?.demonstrations = reached;
    Ok(folded)
}

/// Removes `symbol`.
pub(super) fn remove(
    specification: &mut Specification,
    symbol: Symbol,
    first_new: StateId,
) -> Result<Folded, EditError> {
    known(specification, symbol)?;
    specification.sub_goals.retain(|sub_goal| sub_goal.id != symbol);
    let in_words = specification.demonstrations.iter().any(|shown| shown.word.contains(&symbol));
    if !in_words && specification.pdfa.transitions().all(|(_, used, _)| used != symbol) {
        for state in specification.pdfa.states.values_mut() {
            state.completed.remove(&symbol);
        }
        return Ok(Folded::new());
    }
    reread(specification, &|other| (other != symbol).then_some(other), None, first_new)
}

/// The smallest ball that encloses both, of one subset; none when it has no finite center and radius.
fn enclosing(one: Ball, other: Ball) -> Option<Ball> {
    let apart = distance(&one.center, &other.center);
    if apart + other.radius <= one.radius {
        return Some(one);
    }
    if apart + one.radius <= other.radius {
        return Some(other);
    }
    let radius = (apart + one.radius + other.radius) / 2.0;
    let part = (radius - one.radius) / apart;
    let between = |(a, b): (&f64, &f64)| a + (b - a) * part;
    let center: Vec<f64> = one.center.iter().zip(&other.center).map(between).collect();
    let finite = radius.is_finite() && center.iter().all(|coordinate| coordinate.is_finite());
    finite.then_some(Ball { center, radius, ..one })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(center: [f64; 2], radius: f64) -> Ball {
        let features = vec!["x".to_owned(), "y".to_owned()];
        Ball { subset: "xy".to_owned(), features, center: center.to_vec(), radius }
    }

    #[test]
    fn the_smallest_ball_touches_both_far_sides() {
        let all = enclosing(ball([2.0, 0.0], 1.0), ball([2.0, 8.0], 3.0));
        assert_eq!(all, Some(ball([2.0, 5.0], 6.0)));
    }

    #[test]
    fn a_ball_within_another_adds_nothing() {
        let (large, small) = (ball([0.0, 0.0], 5.0), ball([1.0, 0.0], 2.0));
        assert_eq!(enclosing(large.clone(), small.clone()), Some(large.clone()));
        assert_eq!(enclosing(small, large.clone()), Some(large.clone()));
        assert_eq!(enclosing(large.clone(), large.clone()), Some(large));
    }

    #[test]
    fn points_make_a_ball_between_them() {
        assert_eq!(enclosing(ball([0.0, 0.0], 0.0), ball([2.0, 0.0], 0.0)), Some(ball([1.0, 0.0], 1.0)));
    }

    #[test]
    fn balls_whose_distance_is_no_number_have_none() {
        assert_eq!(enclosing(ball([f64::MAX, 0.0], 1.0), ball([-f64::MAX, 0.0], 1.0)), None);
    }
}
