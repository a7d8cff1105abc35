//! The demonstrations that come with the app, written from simulated tasks whose truth is known.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use goalgraph_tasks::{Task, arm, drone, four_places, tower, two_stacks};

use crate::project::Project;

/// One sample: a folder with a CSV file per demonstration and a README.
struct Sample {
    id: &'static str,
    title: &'static str,
    /// One sentence for the start screen.
    description: &'static str,
    /// What there is to see in it, for the README.
    story: &'static str,
    task: fn() -> Task,
}

const SAMPLES: [Sample; 5] = [
    Sample {
        id: "tower",
        title: "Tower",
        description: "Red and yellow in either order, then green across the top.",
        story: "Nine demonstrations of one small tower. Six people begin with red, three with yellow; green always comes \
                last, because it lies on both. The automaton has one choice, at the start, and one order after it.",
        task: || tower(7, 9),
    },
    Sample {
        id: "two-stacks",
        title: "Two stacks",
        description: "Two stacks of two blocks: six orders, one of them preferred.",
        story: "Yellow goes on red, blue on green; otherwise the order is free, which gives six orders. Most people build \
                the red stack first. Switch yellow off in the Run tab, or try \
                `goalgraph plan two-stacks.json --unavailable yellow`: everything else is done meanwhile.",
        task: || two_stacks(11, 18),
    },
    Sample {
        id: "four-places",
        title: "Four places",
        description: "One cube is carried through four places, in several orders.",
        story: "A single thing that is put down four times. Nothing else moves, so only the cube's own rests tell its \
                sub-goals from the way between them.",
        task: || four_places(5, 12),
    },
    Sample {
        id: "drone",
        title: "Drone",
        description: "A drone stops at three places in mid-air.",
        story: "No table, no hand: the places are where the drone stops. It visits three of them in several orders, metres \
                apart.",
        task: || drone(3, 10),
    },
    Sample {
        id: "arm",
        title: "Two-jointed arm",
        description: "Joint angles of an arm that swings clockwise or counter-clockwise.",
        story: "The features are two joint angles in radians. The arm passes its poses clockwise or counter-clockwise and \
                always ends in the middle: two branches that meet again.",
        task: || arm(9, 10),
    },
];

/// Writes `assets/samples/` again: the same bytes every time.
///
/// # Errors
///
/// When a file cannot be written.
pub(crate) fn regenerate(project: &Project) -> Result<()> {
    let folder = project.root.join("assets/samples");
    if folder.exists() {
        fs::remove_dir_all(&folder).with_context(|| format!("{} cannot be removed", folder.display()))?;
    }
    for sample in &SAMPLES {
        write_sample(&folder.join(sample.id), sample)?;
    }
    write(&folder.join("index.json"), &index())
}

fn write_sample(folder: &Path, sample: &Sample) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    let task = (sample.task)();
    for (index, name) in file_names(&task).iter().enumerate() {
        write(&folder.join(name), &task.csv(index))?;
    }
    write(&folder.join("README.md"), &readme(sample, &task))
}

fn file_names(task: &Task) -> Vec<String> {
    (0..task.demonstrations.len()).map(|index| format!("demo_{index:02}.csv")).collect()
}

fn readme(sample: &Sample, task: &Task) -> String {
    let mut text = format!("# {}\n\n{}\n\n", sample.title, sample.story);
    let frames: usize = task.demonstrations.iter().map(|recording| recording.frames.len()).sum();
    let _ = writeln!(
        text,
        "{} demonstrations, {frames} frames at {} Hz, {} features; simulated, written by `cargo xtask samples`.\n",
        task.demonstrations.len(),
        task.rate_hz,
        task.features.len(),
    );
    let _ = writeln!(text, "| demonstration | order |\n| --- | --- |");
    for (name, recording) in file_names(task).iter().zip(&task.demonstrations) {
        let word: Vec<&str> = recording.word.iter().map(|&place| task.places[place].name.as_str()).collect();
        let _ = writeln!(text, "| {name} | {} |", word.join(", "));
    }
    text
}

/// What the app's start screen reads.
fn index() -> String {
    let entries: Vec<String> = SAMPLES
        .iter()
        .map(|sample| {
            let names = file_names(&(sample.task)());
            format!(
                "  {{\n    \"id\": \"{}\",\n    \"title\": \"{}\",\n    \"description\": \"{}\",\n    \"files\": [{}]\n  }}",
                sample.id,
                sample.title,
                sample.description,
                names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")
            )
        })
        .collect();
    format!("[\n{}\n]\n", entries.join(",\n"))
}

fn write(path: &Path, text: &str) -> Result<()> {
    fs::write(path, text).with_context(|| format!("{} cannot be written", path.display()))
}
