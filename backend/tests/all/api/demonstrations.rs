//! Demonstration files.

use goalgraph::protocol::api::{DemonstrationFile, Page};
use sha2::{Digest, Sha256};

use super::{create, specification};
use crate::http::{Answer, Server, send};

fn sha256(bytes: &[u8]) -> String {
    goalgraph_server::digest::hex(&Sha256::digest(bytes))
}

fn put(server: &Server, sha256: &str, name: &str, bytes: &[u8]) -> Answer {
    let path = format!("/api/v1/demonstrations/{sha256}?name={name}");
    send(server.address, "PUT", &path, &[("content-type", "text/csv")], bytes)
}

#[test]
fn a_file_is_kept_once_and_comes_back_as_it_was() {
    let server = Server::start();
    let bytes: Vec<u8> = (0..3_000_000_u32).map(|n| n.wrapping_mul(2_654_435_761).to_le_bytes()[3]).collect();
    let sha256 = sha256(&bytes);
    let first: DemonstrationFile = put(&server, &sha256, "demo_00.csv", &bytes).expect(201).json();
    assert_eq!((first.name.as_str(), first.bytes), ("demo_00.csv", 3_000_000));
    let again: DemonstrationFile = put(&server, &sha256, "other.csv", &bytes).expect(200).json();
    assert_eq!(again, first);
    let read = server.get(&format!("/api/v1/demonstrations/{sha256}")).expect(200);
    assert_eq!((&read.bytes, read.header("content-disposition")), (&bytes, "attachment"));
}

#[test]
fn a_specification_tells_what_it_was_learned_from() {
    let server = Server::start();
    let (entry, _) = create(&server, &specification("Blocks", &["a b"]));
    let path = format!("/api/v1/specifications/{}/demonstrations", entry.id);
    let files: Vec<String> = ["x\n1\n", "x\n2\n"].map(|text| sha256(text.as_bytes())).to_vec();
    put(&server, &files[0], "one.csv", b"x\n1\n").expect(201);
    put(&server, &files[1], "two.csv", b"x\n2\n").expect(201);
    for (name, file) in [("b.csv", &files[1]), ("a.csv", &files[0]), ("b.csv", &files[1])] {
        server.request("PUT", &format!("{path}/{file}?name={name}"), &[]).expect(204);
    }
    let linked: Page<DemonstrationFile> = server.get(&path).json();
    let names: Vec<_> = linked.items.iter().map(|it| (it.name.as_str(), it.sha256.as_str())).collect();
    assert_eq!(names, [("b.csv", files[1].as_str()), ("a.csv", files[0].as_str())]);
    let missing = "0".repeat(64);
    assert_eq!(server.request("PUT", &format!("{path}/{missing}?name=c.csv"), &[]).status, 404);
}

#[test]
fn a_file_that_is_not_what_its_address_says_is_not_kept() {
    let server = Server::start();
    let promised = sha256(b"x\n1\n");
    let detail = put(&server, &promised, "one.csv", b"x\n2\n").detail(422);
    assert_eq!(detail, format!("the file has the SHA-256 {}, expected {promised}", sha256(b"x\n2\n")));
    assert_eq!(server.get(&format!("/api/v1/demonstrations/{promised}")).status, 404);
    assert_eq!(server.get(&format!("/api/v1/demonstrations/{}", sha256(b"x\n2\n"))).status, 404);
    assert_eq!(put(&server, "..%2f..%2fetc%2fpasswd", "one.csv", b"x").status, 404);
    assert_eq!(put(&server, &promised.to_uppercase(), "one.csv", b"x").status, 404);
    let huge = [("content-length", "5000000000"), ("expect", "100-continue")];
    let path = format!("/api/v1/demonstrations/{promised}?name=huge.csv");
    assert_eq!(
        send(server.address, "PUT", &path, &huge, b"").detail(413),
        "the body is larger than 4294967296 bytes"
    );
}
