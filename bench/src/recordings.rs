//! Demonstrations as the CSV files that people drop.

use goalgraph::demonstration::Demonstration;
use goalgraph::import::{Header, ImportError, import, import_digested};
use goalgraph_tasks::{FRAMES_OF_A_DEMONSTRATION, Task, four_blocks, scattered_rests, tower};

/// Frames of each of the [`nine_files`].
const FRAMES: usize = 300;

/// Frames of a second, which a thing that has come to its last place is seen again and again.
const LAST_SECOND: usize = 20;

/// A file with its name.
#[derive(Clone, Debug)]
pub struct File {
    /// What it is called.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// Nine demonstrations of a tower of three blocks, 300 frames of nine features each, a file a demonstration.
pub fn nine_files() -> Vec<File> {
    let mut task = tower(1, 9);
    for recording in &mut task.demonstrations {
        let frames = &mut recording.frames;
        while frames.len() < FRAMES {
            frames.push(frames[frames.len() - LAST_SECOND.min(frames.len())].clone());
        }
        frames.truncate(FRAMES);
    }
    let file = |index| File { name: format!("demo_{index:02}.csv"), text: task.csv(index) };
    (0..task.demonstrations.len()).map(file).collect()
}

/// At least `megabytes` MB of demonstrations of a tower in one file, numbered by its first column.
pub fn one_file(megabytes: usize) -> File {
    let sample = tower(1, 9).csv_all().len().div_ceil(9);
    let task = tower(1, (megabytes * 1_000_000).div_ceil(sample) + 1);
    File { name: "demonstrations.csv".to_owned(), text: task.csv_all() }
}

/// Demonstrations of a tower with about `frames` frames in all, in one file.
pub fn frames_in_one_file(frames: usize) -> File {
    let of_nine: usize = tower(1, 9).demonstrations.iter().map(|recording| recording.frames.len()).sum();
    let task = tower(1, (9 * frames).div_ceil(of_nine));
    File { name: "demonstrations.csv".to_owned(), text: task.csv_all() }
}

/// `frames` frames of demonstrations that rest where nothing rested before, in one file: every rest is a cluster of its own.
pub fn scattered_in_one_file(frames: usize) -> File {
    let line = |(index, point): (usize, &[f64])| {
        let demonstration = index / FRAMES_OF_A_DEMONSTRATION;
        format!("{demonstration},{:.5},{:.5},{:.5}\n", point[0], point[1], point[2])
    };
    let points = scattered_rests(frames, 1);
    let header = "demo,thing.x,thing.y,thing.z\n".to_owned();
    let text = std::iter::once(header).chain(points.chunks_exact(3).enumerate().map(line)).collect();
    File { name: "scattered.csv".to_owned(), text }
}

/// `demonstrations` of four blocks in two stacks, whose order is free where the stacks allow it.
pub fn blocks(demonstrations: usize) -> Task {
    four_blocks(1, demonstrations)
}

/// The demonstrations in a file.
///
/// # Errors
///
/// When the file breaks its format.
pub fn read(file: &File) -> Result<Vec<Demonstration>, ImportError> {
    import(&file.name, file.text.as_bytes(), Header::Detect)
}

/// The demonstrations in a file whose digest is known, as it is in the browser.
///
/// # Errors
///
/// When the file breaks its format.
pub fn read_digested(file: &File) -> Result<Vec<Demonstration>, ImportError> {
    import_digested(&file.name, "known", file.text.as_bytes(), Header::Detect)
}

#[cfg(test)]
mod tests {
    use goalgraph::infer::{InferRequest, infer};

    use super::*;

    #[test]
    fn nine_demonstrations_have_three_hundred_frames_each() {
        let files = nine_files();
        assert_eq!(files.len(), 9);
        for file in &files {
            let demonstrations = read(file).unwrap();
            assert_eq!((demonstrations.len(), demonstrations[0].frames()), (1, FRAMES));
        }
    }

    #[test]
    fn every_rest_is_somewhere_else_where_rests_are_scattered() {
        let demonstrations = read(&scattered_in_one_file(30 * FRAMES_OF_A_DEMONSTRATION)).unwrap();
        assert_eq!(demonstrations.len(), 30);
        let inference = infer(&demonstrations, &InferRequest::default(), &mut |_| {}).unwrap();
        let clusters = inference.specification.sub_goals.len() + inference.eliminated.len();
        assert!((90..=120).contains(&clusters), "{clusters}");
    }

    #[test]
    fn a_file_is_as_large_as_asked_for() {
        let length = one_file(1).text.len();
        assert!((1_000_000..1_100_000).contains(&length), "{length}");
    }
}
