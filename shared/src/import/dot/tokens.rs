//! Tokens: ids, quoted texts and signs, each with its line.

use super::DotError;

/// A piece of a file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    /// From 1.
    pub(super) line: usize,
    pub(super) kind: Kind,
}

/// What a token is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// A name, number or keyword as it stands there.
    Id(String),
    /// What is between quotes, escapes resolved.
    Quoted(String),
    /// One of `{ } [ ] ; , = : +`.
    Sign(char),
    /// `->`.
    Arrow,
}

impl Token {
    /// The token as it is shown in messages.
    pub(super) fn shown(&self) -> String {
        match &self.kind {
            Kind::Id(text) | Kind::Quoted(text) => shortened(text),
            Kind::Sign(sign) => format!("{:?}", sign.to_string()),
            Kind::Arrow => "\"->\"".to_owned(),
        }
    }
}

/// At most forty characters in quotes.
pub(super) fn shortened(text: &str) -> String {
    const SHOWN: usize = 40;
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{:?}", format!("{}…", &text[..end])),
        None => format!("{text:?}"),
    }
}

/// All tokens; comments and lines that start with # are left out.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, DotError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = Reader { rest: text, line: 1, is_line_start: true };
    let mut tokens = Vec::new();
    while let Some(token) = reader.next()? {
        tokens.push(token);
    }
    Ok(tokens)
}

struct Reader<'a> {
    rest: &'a str,
    line: usize,
    /// Whether only blanks stand before the rest in its line.
    is_line_start: bool,
}

impl Reader<'_> {
    fn next(&mut self) -> Result<Option<Token>, DotError> {
        self.skip_blanks()?;
        let Some(first) = self.rest.chars().next() else {
            return Ok(None);
        };
        let line = self.line;
        let kind = match first {
            '"' => Kind::Quoted(self.quoted()?),
            '-' if self.rest.starts_with("->") => {
                self.take(2);
                Kind::Arrow
            }
            '{' | '}' | '[' | ']' | ';' | ',' | '=' | ':' | '+' => {
                self.take(1);
                Kind::Sign(first)
            }
            '-' if self.rest.starts_with("--") => {
                return Err(DotError::at(line, "\"--\" joins nodes in both directions; expected ->"));
            }
            '<' => return Err(DotError::at(line, "\"<\" starts HTML; expected a text in quotes")),
            _ if is_id(first) || first == '-' => Kind::Id(self.id()),
            _ => {
                let message = format!("{} cannot stand here; expected an id", shortened(&first.to_string()));
                return Err(DotError::at(line, message));
            }
        };
        Ok(Some(Token { line, kind }))
    }

    /// Goes on by `length` bytes, which must be characters of one line.
    fn take(&mut self, length: usize) -> &str {
        let (taken, rest) = self.rest.split_at(length.min(self.rest.len()));
        self.rest = rest;
        self.is_line_start = false;
        taken
    }

    fn skip_blanks(&mut self) -> Result<(), DotError> {
        loop {
            let Some(first) = self.rest.chars().next() else {
                return Ok(());
            };
            if first == '\n' {
                self.take(1);
                self.line += 1;
                self.is_line_start = true;
            } else if first.is_whitespace() {
                self.rest = &self.rest[first.len_utf8()..];
            } else if self.rest.starts_with("//") || (first == '#' && self.is_line_start) {
                let end = self.rest.find('\n').unwrap_or(self.rest.len());
                self.take(end);
            } else if self.rest.starts_with("/*") {
                // The star that opens a comment does not end it.
                let Some(end) = self.rest[2..].find("*/").map(|end| end + 2) else {
                    return Err(DotError::at(self.line, "a comment has no end; expected */"));
                };
                self.line += self.rest[..end].matches('\n').count();
                self.take(end + 2);
            } else {
                return Ok(());
            }
        }
    }

    fn id(&mut self) -> String {
        let sign = usize::from(self.rest.starts_with('-'));
        let end = self.rest[sign..].find(|character| !is_id(character));
        let end = end.map_or(self.rest.len(), |end| sign + end);
        self.take(end).to_owned()
    }

    /// A text in quotes: `\"`, `\\` and line breaks (`\n`, `\l`, `\r`) are escapes, `&..;` stands for a character; a
    /// backslash at the end of a line joins it to the next.
    fn quoted(&mut self) -> Result<String, DotError> {
        let start = self.line;
        let mut text = String::new();
        self.take(1);
        loop {
            let Some(first) = self.rest.chars().next() else {
                return Err(DotError::at(start, "a text in quotes has no end; expected \""));
            };
            match first {
                '"' => {
                    self.take(1);
                    return Ok(text);
                }
                '\\' => text += &self.escape(),
                '&' => text.push(self.entity()),
                other => {
                    self.take(other.len_utf8());
                    self.line += usize::from(other == '\n');
                    text.push(other);
                }
            }
        }
    }

    fn escape(&mut self) -> String {
        self.take(1);
        let Some(escaped) = self.rest.chars().next() else {
            return "\\".to_owned();
        };
        self.take(escaped.len_utf8());
        self.line += usize::from(escaped == '\n');
        match escaped {
            '"' | '\\' => escaped.to_string(),
            'n' | 'l' | 'r' => "\n".to_owned(),
            '\n' => String::new(),
            other => format!("\\{other}"),
        }
    }

    /// The character of an entity, or the & that starts none.
    fn entity(&mut self) -> char {
        const LONGEST: usize = 10;
        let end = self.rest.bytes().take(LONGEST).position(|byte| byte == b';');
        let found = end.and_then(|end| Some((end + 1, entity(self.rest.get(1..end)?)?)));
        let (length, character) = found.unwrap_or((1, '&'));
        self.take(length);
        character
    }
}

fn entity(name: &str) -> Option<char> {
    match name {
        "quot" => Some('"'),
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        _ => {
            let number = name.strip_prefix('#')?;
            let hexadecimal = number.strip_prefix(['x', 'X']);
            let code = match hexadecimal {
                Some(digits) => u32::from_str_radix(digits, 16).ok()?,
                None => number.parse().ok()?,
            };
            char::from_u32(code)
        }
    }
}

fn is_id(character: char) -> bool {
    let is_foreign = !character.is_ascii() && !character.is_whitespace();
    character.is_alphanumeric() || matches!(character, '_' | '.') || is_foreign
}
