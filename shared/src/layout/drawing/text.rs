//! Texts: how wide they will be about, and short forms.

/// About how wide `text` is in a proportional sans-serif typeface of `size`; rather too much than too little. The same
/// everywhere, whatever typeface is there in the end.
pub fn text_width(text: &str, size: f64) -> f64 {
    text.chars().map(em_width).sum::<f64>() * size
}

/// Width of a character as a share of the size of its typeface.
fn em_width(character: char) -> f64 {
    match character {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | 'I' | ' ' => 0.31,
        'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '{' | '}' | '/' | '-' | '"' => 0.41,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '…' => 0.92,
        'A'..='Z' | '<' | '>' | '+' | '=' | '&' => 0.68,
        '\u{0}'..='\u{1f}' | '\u{300}'..='\u{36f}' | '\u{200b}'..='\u{200f}' => 0.0,
        '\u{1100}'.. => 1.05,
        _ => 0.58,
    }
}

/// `text` in at most `characters` characters, an ellipsis for what is left out of its middle: names often differ at their
/// ends.
pub fn shortened(text: &str, characters: usize) -> String {
    let all: Vec<char> = text.chars().collect();
    if all.len() <= characters {
        return text.to_owned();
    }
    let kept = characters.saturating_sub(1);
    let (head, tail) = (kept - kept / 3, kept / 3);
    all[..head].iter().chain(&['…']).chain(&all[all.len() - tail..]).collect()
}

/// A probability in two digits after the point; what is neither 0 nor 1 is not rounded to it.
pub fn probability_text(probability: f64) -> String {
    match probability {
        p if p <= 0.0 => "0".to_owned(),
        p if p >= 1.0 => "1".to_owned(),
        p if p < 0.005 => "<0.01".to_owned(),
        p if p >= 0.995 => ">0.99".to_owned(),
        p => format!("{p:.2}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_names_are_kept_and_long_ones_keep_both_ends() {
        assert_eq!(shortened("red 1", 8), "red 1");
        assert_eq!(shortened("the red block 12", 8), "the r…12");
        assert_eq!(shortened("ééééé", 4), "éé…é");
        assert_eq!(shortened("abc", 0), "…");
    }

    #[test]
    fn only_certainty_is_written_as_zero_or_one() {
        let texts = [0.0, 0.001, 0.666_666, 0.999, 1.0].map(probability_text);
        assert_eq!(texts, ["0", "<0.01", "0.67", ">0.99", "1"]);
    }

    #[test]
    fn wide_scripts_are_wider() {
        assert!(text_width("漢字", 10.0) > text_width("ab", 10.0));
        assert!(text_width("mmm", 10.0) > text_width("iii", 10.0));
        assert!(text_width("", 10.0).abs() < f64::EPSILON);
    }
}
