//! Files that hold no recording but a specification.

use std::path::Path;

use goalgraph::import::dot::read_dot;
use goalgraph::specification::Specification;

/// The largest file that is opened for editing: the page keeps every step of the history.
const LARGEST: usize = 25_000_000;

/// Whether a file is a specification or an automaton in Graphviz syntax, by its name or how it begins.
pub(super) fn is_specification(name: &str, bytes: &[u8]) -> bool {
    let begins = String::from_utf8_lossy(&bytes[..bytes.len().min(400)]);
    name.to_lowercase().ends_with(".goalgraph.json")
        || is_dot(name)
        || begins.contains("\"goalgraph-specification\"")
}

fn is_dot(name: &str) -> bool {
    let extension = Path::new(name).extension();
    extension.is_some_and(|it| it.eq_ignore_ascii_case("dot") || it.eq_ignore_ascii_case("gv"))
}

/// The specification in `bytes`, as Goalgraph writes it.
pub(super) fn opened(name: &str, bytes: &[u8]) -> Result<String, String> {
    if bytes.len() > LARGEST {
        let (size, limit) = (bytes.len() / 1_000_000, LARGEST / 1_000_000);
        return Err(format!("it has {size} MB; a specification to edit has up to {limit} MB"));
    }
    let text =
        std::str::from_utf8(bytes).map_err(|error| format!("byte {}: no UTF-8 text", error.valid_up_to()))?;
    let specification = if is_dot(name) {
        read_dot(text).map_err(|error| error.to_string())?
    } else {
        Specification::from_json(text).map_err(|error| error.to_string())?
    };
    Ok(specification.to_json())
}

#[cfg(test)]
mod tests {
    use goalgraph::export::{ExportFormat, export};
    use goalgraph::infer::infer_words;
    use goalgraph::pdfa::Semantics;

    use super::*;

    #[test]
    fn specifications_are_known_by_name_or_by_how_they_begin() {
        assert!(is_specification("Tower.GOALGRAPH.json", b""));
        assert!(is_specification("tower.dot", b""));
        assert!(is_specification("x.json", b"{\n  \"format\": \"goalgraph-specification\","));
        assert!(!is_specification("demo.json", b"{\"features\": []}"));
    }

    #[test]
    fn a_specification_and_its_drawing_are_opened() {
        let words = [vec!["a".to_owned(), "b".to_owned()]];
        let specification = infer_words("Tower", Semantics::default(), &words);
        let text = specification.to_json();
        assert_eq!(opened("x.goalgraph.json", text.as_bytes()), Ok(text));
        let dot = export(&specification, ExportFormat::Dot);
        let read = Specification::from_json(&opened("x.dot", dot.as_bytes()).unwrap()).unwrap();
        assert_eq!(read.pdfa.states.len(), 3);
    }

    #[test]
    fn what_cannot_be_opened_is_refused_with_the_reason() {
        assert_eq!(opened("x.dot", b"\xff").unwrap_err(), "byte 0: no UTF-8 text");
        assert!(opened("x.goalgraph.json", b"{").unwrap_err().starts_with("line 1"));
        let large = vec![b' '; LARGEST + 1];
        assert!(opened("x.goalgraph.json", &large).unwrap_err().contains("25 MB"));
    }
}
