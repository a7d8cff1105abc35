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
/// O(W · A · log F) for a word of W symbols and A sub-goals that hold in up to F frames each: whatever follows a
/// sub-goal's completion is not looked at.
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
pub fn read_word(reached: &[Reached<'_>]) -> Word {
    completions(reached).into_iter().map(|(symbol, _)| symbol).collect()
}

/// The symbols of the [word](read_word), each with the frame in which it was completed.
///
/// # Complexity
///
/// That of [`read_word`].
pub fn completions(reached: &[Reached<'_>]) -> Vec<(Symbol, usize)> {
    let mut completed: Vec<(Symbol, usize)> = Vec::new();
    let mut open = reached.to_vec();
    // Of one frame the least pair is that of the first sub-goal.
    while let Some((frame, position)) =
        (0..open.len()).filter_map(|position| Some((*open[position].frames.first()?, position))).min()
    {
        completed.push((open.remove(position).symbol, frame));
        for sub_goal in &mut open {
            sub_goal.frames = after(frame, sub_goal.frames);
        }
    }
    completed
}

/// Those of the ascending `frames` that are behind `frame`.
fn after(frame: usize, frames: &[usize]) -> &[usize] {
    match frames {
        [first, ..] if *first <= frame => &frames[frames.partition_point(|&other| other <= frame)..],
        _ => frames,
    }
}

#[cfg(test)]
mod tests {
    use proptest::collection::{btree_set, vec};
    use proptest::prelude::*;

    use super::*;

    /// Algorithm 1, frame by frame.
    fn by_frames(reached: &[Reached<'_>]) -> Vec<(Symbol, usize)> {
        let end = reached.iter().filter_map(|it| it.frames.last()).max().map_or(0, |last| last + 1);
        let mut completed: Vec<(Symbol, usize)> = Vec::new();
        for frame in 0..end {
            let is_new = |symbol| completed.iter().all(|&(known, _)| known != symbol);
            let first = reached.iter().find(|it| it.frames.contains(&frame) && is_new(it.symbol));
            completed.extend(first.map(|it| (it.symbol, frame)));
        }
        completed
    }

    proptest! {
        #[test]
        fn words_are_those_read_frame_by_frame(frames in vec(btree_set(0_usize..30, 0..20), 0..8)) {
            let frames: Vec<Vec<usize>> = frames.into_iter().map(|it| it.into_iter().collect()).collect();
            // The order of the sub-goals is that of the list, not that of their numbers.
            let symbols = (0..frames.len() as u32).rev().map(Symbol);
            let reached: Vec<Reached<'_>> =
                symbols.zip(&frames).map(|(symbol, frames)| Reached { symbol, frames }).collect();
            prop_assert_eq!(completions(&reached), by_frames(&reached));
        }
    }
}
