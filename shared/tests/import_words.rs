//! Files of words: one a line, and Abbadingo.

use goalgraph::import::import_words;

/// Words separated by `/`, then the number of rejected ones; or the error.
#[track_caller]
fn check(text: &str, expected: &str) {
    let shown = match import_words(text.as_bytes()) {
        Ok(file) => {
            let named = |word| file.named(word).collect::<Vec<_>>().join(" ");
            let words: Vec<_> = file.words.iter().map(|word| named(word)).collect();
            format!("{} +{}", words.join("/"), file.rejected)
        }
        Err(error) => error.to_string(),
    };
    assert_eq!(shown, expected, "{text:?}");
}

#[test]
fn a_line_is_a_word() {
    check("a b c\nb a c\n", "a b c/b a c +0");
    check("\u{feff}a  b\tc\r\n b2x2@10,0 \r\n", "a b c/b2x2@10,0 +0");
    check("0 1 2\n1 0 2\n2 1 0\n", "0 1 2/1 0 2/2 1 0 +0");
    check("1 2\n2 1\n", "1 2/2 1 +0");
}

#[test]
fn a_blank_line_is_no_word() {
    check("\na\n\n  \nb\n\n", "a/b +0");
    check("\n \n", "the file is empty");
}

#[test]
fn abbadingo_files_say_which_words_are_of_the_task() {
    check("3 2\n1 2 0 1\n0 1 1\n1 3 0 1 1\n", "0 1/0 1 1 +1");
    check("2 2\n1 0\n1 1 0\n", "/0 +0");
}

#[test]
fn abbadingo_files_that_contradict_themselves_are_refused() {
    check("3 2\n1 2 0 1\n1 1 1\n", "line 1: the first line announces 3 words, but 2 follow");
    check("3 2\n1 2 0 1\n1 1 1\n1 2 0\n", "line 4: 1 symbol, but the length says 2");
    check("3 2\n1 2 0 1\n1 1 1\n1\n", "line 4: expected a label, a length and the symbols");
    check("3 2\n1 1 0\n1 1 0\n1 x 0\n", "line 4: the length is \"x\"; expected a whole number");
    check("2 2\n1 1 0\n-1 1 0\n", "line 3: the label is \"-1\"; expected 1 (accepted) or 0 (rejected)");
    check("1 2\n0 1 0\n", "there are rejected words only (1); expected accepted ones");
}

#[test]
fn what_holds_no_words_is_refused() {
    check("", "the file is empty");
    check("%PDF-1.7", "this is a PDF document; expected words, one a line");
    check("<html>", "this is an HTML page; expected words, one a line");
    assert!(import_words(b"a\0b").is_err());
}
