//! Tasks as CSV files.

use crate::task::{Recording, Task, Unit};

impl Task {
    /// One demonstration as CSV: a header with the feature names, then one line a frame.
    ///
    /// An undefined value is an empty cell; lines end in `\n`.
    ///
    /// # Panics
    ///
    /// When there is no demonstration with this index.
    pub fn csv(&self, index: usize) -> String {
        let mut text = self.features.join(",") + "\n";
        push_lines(&mut text, &self.demonstrations[index], self.unit, "");
        text
    }

    /// All demonstrations as one CSV whose first column, `demo`, counts them from 0.
    pub fn csv_all(&self) -> String {
        let mut text = format!("demo,{}\n", self.features.join(","));
        for (index, demonstration) in self.demonstrations.iter().enumerate() {
            push_lines(&mut text, demonstration, self.unit, &format!("{index},"));
        }
        text
    }
}

fn push_lines(text: &mut String, demonstration: &Recording, unit: Unit, prefix: &str) {
    for frame in &demonstration.frames {
        let cells: Vec<String> = frame.iter().map(|&value| cell(value, unit)).collect();
        text.push_str(prefix);
        text.push_str(&cells.join(","));
        text.push('\n');
    }
}

fn cell(value: f64, unit: Unit) -> String {
    if value.is_nan() {
        return String::new();
    }
    let text = format!("{value:.0$}", unit.decimals());
    let is_zero = text.bytes().all(|byte| b"-0.".contains(&byte));
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_undefined_value_is_an_empty_cell() {
        assert_eq!(cell(f64::NAN, Unit::Metre), "");
    }

    #[test]
    fn zero_has_no_sign() {
        assert_eq!(cell(-0.000_001, Unit::Metre), "0.00000");
        assert_eq!(cell(-1.5, Unit::Millimetre), "-1.50");
    }
}
