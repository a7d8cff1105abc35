//! Words: the sub-goals that a demonstration completed, in order.

use crate::pdfa::{Symbol, Word};

/// When a sub-goal was reached: the frames in which it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached<'a> {
    /// The sub-goal's symbol.
    pub symbol: Symbol,
    /// Indices of the frames in which the partial state counts as being in its ball, ascending.
    pub frames: &'a [usize],
}

/// Reads the word of a demonstration: the paper's Algorithm 1.
///
/// For every frame in order, the first sub-goal in the order of `reached` that is not yet in the word and holds in the
/// frame is appended; at most one symbol per frame.
///
/// # Complexity
///
/// O(F log F + F · A) for F frames in which any of the A sub-goals holds.
///
/// # Example
///
/// ```
/// use goalgraph::pdfa::Symbol;
/// use goalgraph::word::{Reached, read_word};
///
/// let (a, b) = (Symbol(0), Symbol(1));
/// let reached = [Reached { symbol: a, frames: &[7, 8] }, Reached { symbol: b, frames: &[3, 7] }];
/// assert_eq!(read_word(&reached), [b, a]);
/// ```
pub fn read_word(reached: &[Reached]) -> Word {
    completions(reached).into_iter().map(|(symbol, _)| symbol).collect()
}

/// The symbols of the [word](read_word), each with the frame in which it was completed.
///
/// # Complexity
///
/// That of [`read_word`].
pub fn completions(reached: &[Reached]) -> Vec<(Symbol, usize)> {
    let mut frames: Vec<(usize, usize)> = Vec::new();
    for (position, sub_goal) in reached.iter().enumerate() {
        frames.extend(sub_goal.frames.iter().map(|&frame| (frame, position)));
    }
    frames.sort_unstable();
    let mut completed: Vec<(Symbol, usize)> = Vec::new();
    let mut in_word = vec![false; reached.len()];
    for (frame, position) in frames {
        let taken = completed.last().is_some_and(|&(_, last_frame)| last_frame == frame);
        if !taken && !in_word[position] {
            in_word[position] = true;
            completed.push((reached[position].symbol, frame));
        }
    }
    completed
}
