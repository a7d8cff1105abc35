//! Recordings, kept by their SHA-256 beside the specifications that use them.

use gloo_net::http::Request;
use goalgraph::protocol::api::DemonstrationFile;
use web_sys::File;

use super::ROOT;
use super::answer::{Failure, all, ask, escaped, send};

/// The recordings that a specification uses.
pub(crate) async fn linked_demonstrations(id: &str) -> Result<Vec<DemonstrationFile>, Failure> {
    all(&format!("{ROOT}/specifications/{}/demonstrations", escaped(id))).await
}

/// Gives the server a recording.
pub(crate) async fn put_demonstration(sha256: &str, file: &File) -> Result<(), Failure> {
    let address = format!("{ROOT}/demonstrations/{sha256}?name={}", escaped(&file.name()));
    let request = Request::put(&address).header("Content-Type", "application/octet-stream");
    send(request.body(file.clone())).await.map(drop)
}

/// Says that a specification uses a recording that the server has.
pub(crate) async fn link_demonstration(id: &str, sha256: &str, name: &str) -> Result<(), Failure> {
    let name = escaped(name);
    let address = format!("{ROOT}/specifications/{}/demonstrations/{sha256}?name={name}", escaped(id));
    ask(Request::put(&address)).await.map(drop)
}

/// The bytes of a recording.
pub(crate) async fn demonstration(sha256: &str) -> Result<Vec<u8>, Failure> {
    let response = ask(Request::get(&format!("{ROOT}/demonstrations/{sha256}"))).await?;
    response.binary().await.map_err(|error| Failure::Strange(error.to_string()))
}
