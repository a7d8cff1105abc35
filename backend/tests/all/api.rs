//! The API over real sockets, with a real database.

mod approvals;
mod demonstrations;
mod description;
mod faults;
mod sign_in;
mod specifications;

use goalgraph::infer::infer_words;
use goalgraph::pdfa::Semantics;
use goalgraph::protocol::api::{Save, SpecificationEntry};
use serde_json::{Value, json};

use crate::http::{Answer, Server};

/// A specification of these words.
fn specification(name: &str, words: &[&str]) -> String {
    let words: Vec<Vec<String>> =
        words.iter().map(|word| word.split(' ').map(ToOwned::to_owned).collect()).collect();
    infer_words(name, Semantics::MaximumLikelihood, &words).to_json()
}

fn save(content: &str, author: &str) -> Value {
    let save = Save {
        content: content.to_owned(),
        author: Some(author.to_owned()),
        message: String::new(),
        positions: None,
    };
    json!(save)
}

fn create(server: &Server, content: &str) -> (SpecificationEntry, String) {
    saved(&server.send_json("POST", "/api/v1/specifications", &[], &save(content, "Ada")).expect(201))
}

fn saved(answer: &Answer) -> (SpecificationEntry, String) {
    (answer.json(), answer.header("etag").to_owned())
}
