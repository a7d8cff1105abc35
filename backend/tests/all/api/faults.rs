//! Bad requests, and a server that cannot work.

use std::io::{Read, Write};
use std::net::TcpStream;

use goalgraph_server::access::AccessSettings;
use goalgraph_server::store::StoreOptions;

use super::{create, save, specification};
use crate::http::{Server, send};

#[test]
fn what_cannot_be_read_is_answered_with_one_sentence() {
    let server = Server::start();
    let post = |headers: &[(&str, &str)], body: &[u8]| {
        send(server.address, "POST", "/api/v1/specifications", headers, body)
    };
    let json = [("content-type", "application/json")];
    assert_eq!(post(&[], b"{}").detail(415), "expected a body of the media type application/json");
    assert!(post(&json, b"{").detail(400).contains("line 1 column 1"));
    assert!(post(&json, b"\xff\xfe").detail(400).contains("JSON"));
    assert!(post(&json, b"[]").detail(422).contains("invalid"));
    let large = [("content-type", "application/json"), ("content-length", "40000000")];
    assert_eq!(post(&large, b"").detail(413), "the body is larger than 33554432 bytes");
    let deep = [b"[".repeat(100_000), b"]".repeat(100_000)].concat();
    assert!(matches!(post(&json, &deep).status, 400 | 422));
}

#[test]
fn addresses_that_name_nothing_are_not_found() {
    let server = Server::start();
    for path in [
        "/api/v1/specifications/%00",
        "/api/v1/specifications/..%2f..",
        "/api/v1/specifications/0/revisions/-1",
        "/api/v1/specifications/0/revisions/99999999999999999999999",
        "/api/v1/specifications/0/revisions/18446744073709551615",
        "/api/v1/runs/%F0%9F%A7%B1",
        "/api/v2/specifications",
        "/api/",
    ] {
        assert_eq!(server.get(path).status, 404, "{path}");
    }
    let answer = server.request("PATCH", "/api/v1/specifications", &[]).expect(405);
    assert_eq!(answer.header("allow"), "GET,HEAD,POST");
    assert!(answer.detail(405).starts_with("this address does not answer to this method"));
}

#[test]
fn a_full_database_is_said_and_what_was_saved_stays() {
    let options = StoreOptions { max_pages: Some(60), ..StoreOptions::default() };
    let server = Server::with(|_| None, AccessSettings::default(), options);
    let (kept, _) = create(&server, &specification("Blocks", &["a b"]));
    let word = (0..400).map(|n| format!("s{n}")).collect::<Vec<_>>().join(" ");
    let body = save(&specification("Long", &[&word]), "Ada");
    let detail = server.send_json("POST", "/api/v1/specifications", &[], &body).detail(507);
    assert!(detail.starts_with("there is no space left for the database"), "{detail}");
    server.get(&format!("/api/v1/specifications/{}/revisions/1", kept.id)).expect(200);
    create(&server, &specification("Small", &["a"]));
}

#[test]
fn a_client_that_sends_its_request_byte_by_byte_or_leaves_does_no_harm() {
    let server = Server::start();
    for _ in 0..50 {
        let mut stream = TcpStream::connect(server.address).unwrap();
        stream.write_all(b"POST /api/v1/specifications HTTP/1.1\r\ncontent-length: 1000\r\n").unwrap();
    }
    let mut slow = TcpStream::connect(server.address).unwrap();
    for byte in
        format!("GET /api/v1/health HTTP/1.1\r\nhost: {}\r\nconnection: close\r\n\r\n", server.address)
            .bytes()
    {
        slow.write_all(&[byte]).unwrap();
    }
    let mut answer = String::new();
    slow.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
}

#[test]
fn one_client_that_asks_without_end_is_told_to_wait() {
    let server = Server::start();
    let mut stream = TcpStream::connect(server.address).unwrap();
    let request = format!("GET /api/v1/health HTTP/1.1\r\nhost: {}\r\n\r\n", server.address);
    let mut refused = false;
    let mut buffer = vec![0; 65_536];
    for _ in 0..400 {
        stream.write_all(request.repeat(20).as_bytes()).unwrap();
        let read = stream.read(&mut buffer).unwrap();
        refused |= String::from_utf8_lossy(&buffer[..read]).contains(" 429 ");
        if refused {
            break;
        }
    }
    assert!(refused);
}
