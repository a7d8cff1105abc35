//! How a table is laid out: what comes before it and what separates its cells.

use csv::ByteRecord;

use crate::import::cell::Decimal;
use crate::import::text::line_at;

/// What stands between cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    Comma,
    Semicolon,
    Tab,
    /// One blank or several.
    Blank,
}

/// A table and what surrounds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout<'a> {
    /// The whole file.
    pub(super) text: &'a str,
    /// The file from its first line that is neither blank nor a comment.
    pub(super) body: &'a str,
    /// The last comment before the body, without its `#`.
    pub(super) comment: Option<&'a str>,
    pub(super) separator: Separator,
}

impl Separator {
    pub(super) fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Blank => b' ',
        }
    }

    /// A comma may be a decimal sign only where semicolons separate.
    pub(super) fn decimal(self) -> Decimal {
        if self == Self::Semicolon { Decimal::PointOrComma } else { Decimal::Point }
    }

    fn detect(line: &str) -> Self {
        let mut is_quoted = false;
        let outside: String = line
            .trim()
            .chars()
            .filter(|&character| {
                is_quoted ^= character == '"';
                !is_quoted
            })
            .collect();
        // A lone `x [m]` is one name with its unit.
        let outside = outside.replace(" [", "[").replace(" (", "(");
        [('\t', Self::Tab), (';', Self::Semicolon), (',', Self::Comma), (' ', Self::Blank)]
            .into_iter()
            .find_map(|(character, separator)| outside.contains(character).then_some(separator))
            .unwrap_or(Self::Comma)
    }
}

impl<'a> Layout<'a> {
    /// The layout by the first lines.
    pub(super) fn detect(text: &'a str) -> Self {
        let mut body = text;
        let mut comment = None;
        loop {
            let end = body.find(['\n', '\r']).unwrap_or(body.len());
            let line = body[..end].trim();
            let remark = line.strip_prefix('#');
            // Spreadsheets open a table with `sep=;`, which the detection needs not be told.
            let is_table = !line.is_empty() && remark.is_none() && !line.starts_with("sep=");
            if is_table || end == body.len() {
                let body = if is_table { body.trim_start_matches('\u{feff}') } else { "" };
                return Self { text, body, comment, separator: Separator::detect(line) };
            }
            comment = remark.or(comment);
            body = &body[end + 1..];
        }
    }

    /// The trimmed cells of a line.
    pub(super) fn cells<'r>(&self, record: &'r ByteRecord) -> impl Iterator<Item = &'r [u8]> + use<'r> {
        let blanks_separate = self.separator == Separator::Blank;
        record.iter().map(<[u8]>::trim_ascii).filter(move |cell| !(blanks_separate && cell.is_empty()))
    }

    /// Whether a line holds blanks only. A pair of quotation marks in a table of one column is an undefined value.
    pub(super) fn is_blank(&self, record: &ByteRecord) -> bool {
        match self.separator {
            Separator::Blank => self.cells(record).next().is_none(),
            _ => record.len() == 1 && !record[0].is_empty() && record[0].trim_ascii().is_empty(),
        }
    }

    /// The byte of the file at which the body begins.
    pub(super) fn start(&self) -> usize {
        self.text.len() - self.body.len()
    }

    /// The number, from 1, of the line that begins at byte `place` of the file, or behind the line ends there.
    pub(super) fn line_at(&self, place: usize) -> usize {
        let bytes = self.text.as_bytes();
        let ends = bytes.iter().skip(place).take_while(|byte| b"\r\n".contains(byte)).count();
        line_at(bytes, place + ends)
    }
}
