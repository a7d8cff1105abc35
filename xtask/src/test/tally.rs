//! Counting tests from what their runners print.

use std::fmt;
use std::ops::AddAssign;

/// How many tests passed, failed and were left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    pub(super) passed: usize,
    pub(super) failed: usize,
    pub(super) ignored: usize,
}

impl Tally {
    /// Adds what a line says, if it is a summary line of nextest, libtest, pytest or Playwright.
    pub(super) fn read(&mut self, line: &str) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_summary = match words[..] {
            ["Summary", ..] | ["test", "result:", ..] => true,
            // pytest: between two rules.
            [first, .., last] if is_rule(first) && is_rule(last) => true,
            // Playwright: a count and a word, indented, on a line of its own, with a time at most.
            [count, _, ref rest @ ..] => {
                line.starts_with(' ')
                    && count.bytes().all(|byte| byte.is_ascii_digit())
                    && rest.iter().all(|word| word.starts_with('('))
            }
            _ => false,
        };
        if !is_summary {
            return;
        }
        for pair in words.windows(2) {
            let Ok(count) = pair[0].parse::<usize>() else {
                continue;
            };
            match pair[1].trim_end_matches([',', ';']) {
                "passed" | "flaky" => self.passed += count,
                "failed" | "interrupted" => self.failed += count,
                "ignored" | "skipped" => self.ignored += count,
                _ => {}
            }
        }
    }
}

fn is_rule(word: &str) -> bool {
    word.len() > 1 && word.bytes().all(|byte| byte == b'=')
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.ignored += other.ignored;
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::default() {
            return Ok(());
        }
        write!(f, "{} passed, {} failed, {} ignored", self.passed, self.failed, self.ignored)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(line: &str, expected: [usize; 3]) {
        let mut tally = Tally::default();
        tally.read(line);
        assert_eq!([tally.passed, tally.failed, tally.ignored], expected, "{line}");
    }

    #[test]
    fn summaries_of_all_runners_are_read() {
        check("     Summary [   0.512s] 24 tests run: 21 passed (1 slow), 3 failed, 2 skipped", [21, 3, 2]);
        check("test result: ok. 7 passed; 1 failed; 2 ignored; 0 measured; 4 filtered out", [7, 1, 2]);
        check("=========== 1 failed, 22 passed, 3 skipped in 1.88s ===========", [22, 1, 3]);
        check("  4 passed (5.0s)", [4, 0, 0]);
        check("  1 failed", [0, 1, 0]);
        check("  2 skipped", [0, 0, 2]);
    }

    #[test]
    fn other_lines_are_not_counted() {
        check("", [0, 0, 0]);
        check("the 3 passed", [0, 0, 0]);
        check("=========== test session starts ===========", [0, 0, 0]);
        check("  3 passed the exam", [0, 0, 0]);
        check("  1 smoke.spec.ts:3:5 > the app opens", [0, 0, 0]);
    }
}
