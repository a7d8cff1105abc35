//! From bytes to text: encodings, and files that are no text at all.

use memchr::memchr;

use super::ImportError;

/// How files of other formats begin.
const SIGNATURES: [(&[u8], &str); 18] = [
    (b"PAR1", "a Parquet file"),
    (b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
    (b"\x89MCAP0\r\n", "an MCAP file"),
    (b"#ROSBAG", "a ROS bag"),
    (b"SQLite format 3\0", "an SQLite database"),
    (b"ARROW1", "an Arrow file"),
    (b"\x93NUMPY", "a NumPy file"),
    (b"PK\x03\x04", "a ZIP archive (as .xlsx and .npz are)"),
    (b"PK\x05\x06", "an empty ZIP archive"),
    (b"\xd0\xcf\x11\xe0", "an old Excel or Word file"),
    (b"\x1f\x8b", "a gzip file"),
    (b"\x28\xb5\x2f\xfd", "a zstd file"),
    (b"\x89PNG", "a PNG image"),
    (b"\xff\xd8\xff", "a JPEG image"),
    (b"GIF8", "a GIF image"),
    (b"%PDF-", "a PDF document"),
    (b"\xff\xfe", "UTF-16 text"),
    (b"\xfe\xff", "UTF-16 text"),
];

/// The text in `bytes`, without a byte order mark; `expected` names the formats that would do.
///
/// # Errors
///
/// When there is nothing but blanks, a known signature of another format, a NUL byte or invalid UTF-8.
pub(super) fn text<'a>(bytes: &'a [u8], expected: &str) -> Result<&'a str, ImportError> {
    if let Some((_, what)) = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature)) {
        return Err(ImportError::whole(format!("this is {what}; expected {expected}")));
    }
    if memchr(0, bytes).is_some() {
        return Err(ImportError::whole(format!("this is a binary file; expected {expected}")));
    }
    let text = str::from_utf8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)).map_err(|error| {
        let line = line_at(bytes, error.valid_up_to());
        ImportError::at(line, format!("this is no UTF-8 text; expected {expected} in UTF-8"))
    })?;
    let start = text.trim_start();
    if start.is_empty() {
        return Err(ImportError::whole("the file is empty"));
    }
    match markup(start) {
        Some(what) => Err(ImportError::whole(format!("this is {what}; expected {expected}"))),
        None => Ok(text),
    }
}

/// The number, from 1, of the line that holds byte `offset`; lines end in `\n`, `\r\n` or `\r`.
pub(super) fn line_at(bytes: &[u8], offset: usize) -> usize {
    let before = &bytes[..offset.min(bytes.len())];
    let ends_at =
        |at: usize| before[at] == b'\n' || (before[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n'));
    1 + (0..before.len()).filter(|&at| ends_at(at)).count()
}

/// `text` in quotes, at most 40 characters of it.
pub(super) fn quoted(text: &str) -> String {
    format!("{:?}", shortened(text, 40))
}

/// The first `limit` characters of `text`, with an ellipsis when there are more.
pub(super) fn shortened(text: &str, limit: usize) -> String {
    match text.char_indices().nth(limit) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// `1 value`, `2 values`.
pub(super) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

fn markup(start: &str) -> Option<&'static str> {
    let head: String = start.chars().take(14).collect::<String>().to_ascii_lowercase();
    if head.starts_with("<!doctype html") || head.starts_with("<html") {
        return Some("an HTML page");
    }
    let is_tag = |next: char| next.is_ascii_alphabetic() || next == '?' || next == '!';
    (head.starts_with('<') && head.chars().nth(1).is_some_and(is_tag)).then_some("an XML file")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_any_of_the_three_ways() {
        assert_eq!(line_at(b"a\nb\r\nc\rd", 0), 1);
        assert_eq!(line_at(b"a\nb\r\nc\rd", 2), 2);
        assert_eq!(line_at(b"a\nb\r\nc\rd", 4), 2);
        assert_eq!(line_at(b"a\nb\r\nc\rd", 5), 3);
        assert_eq!(line_at(b"a\nb\r\nc\rd", 7), 4);
    }

    #[test]
    fn a_long_text_is_cut_between_characters() {
        assert_eq!(shortened("äöü", 2), "äö…");
        assert_eq!(shortened("äöü", 3), "äöü");
    }
}
