//! The server over real sockets of this computer.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};

use crate::support::Bench;
use goalgraph_server::server::{Asset, app};

const PAGE: &str = "<!doctype html><script type=\"module\" src=\"boot.js\"></script>";

fn files(path: &str) -> Option<Asset> {
    let content: &'static [u8] = match path {
        "index.html" => PAGE.as_bytes(),
        "app-9c0f3a1be2d45768_bg.wasm" => b"\0asm plain",
        "app-9c0f3a1be2d45768_bg.wasm.br" => b"compressed",
        "worker.js" => b"work()",
        "samples/tower/demo_00.csv" => b"x\n1\n",
        _ => return None,
    };
    Some(Asset::new(content))
}

fn no_files(_: &str) -> Option<Asset> {
    None
}

/// Serves on a free port until the test program ends.
fn start(assets: fn(&str) -> Option<Asset>) -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    listener.set_nonblocking(true).unwrap();
    let address = listener.local_addr().unwrap();
    std::thread::spawn(move || {
        tokio::runtime::Runtime::new().unwrap().block_on(async {
            let listener = tokio::net::TcpListener::from_std(listener).unwrap();
            axum::serve(listener, app(assets)).await.unwrap();
        });
    });
    address
}

#[derive(Debug)]
struct Answer {
    status: u16,
    headers: Vec<(String, String)>,
    body: String,
}

impl Answer {
    fn header(&self, name: &str) -> &str {
        let found = self.headers.iter().find(|(header, _)| header == name);
        found.map_or("", |(_, value)| value)
    }
}

fn request(address: SocketAddr, method: &str, path: &str, headers: &[(&str, &str)]) -> Answer {
    let mut stream = TcpStream::connect(address).unwrap();
    let mut text = format!("{method} {path} HTTP/1.1\r\nhost: {address}\r\nconnection: close\r\n");
    for (name, value) in headers {
        text.extend([*name, ": ", *value, "\r\n"]);
    }
    stream.write_all((text + "\r\n").as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    let mut lines = head.lines();
    let status = lines.next().unwrap().split(' ').nth(1).unwrap().parse().unwrap();
    let header = |line: &str| {
        let (name, value) = line.split_once(": ").unwrap();
        (name.to_owned(), value.to_owned())
    };
    Answer { status, headers: lines.map(header).collect(), body: body.to_owned() }
}

fn get(address: SocketAddr, path: &str) -> Answer {
    request(address, "GET", path, &[])
}

#[test]
fn the_page_allows_what_it_is_made_of_and_nothing_else() {
    let address = start(files);
    let page = get(address, "/");
    assert_eq!((page.status, page.body.as_str()), (200, PAGE));
    assert_eq!(page.header("content-type"), "text/html; charset=utf-8");
    assert_eq!(page.header("cache-control"), "no-cache");
    let policy = page.header("content-security-policy");
    assert!(policy.starts_with("default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; "), "{policy}");
    assert!(policy.contains("; style-src 'self'; ") && !policy.contains("unsafe-inline"), "{policy}");

    // A browser takes the policy of this answer for the page it has kept.
    let known = request(address, "GET", "/index.html", &[("if-none-match", page.header("etag"))]);
    assert_eq!((known.status, known.body.as_str()), (304, ""));
    assert_eq!(known.header("content-security-policy"), policy);
}

#[test]
fn every_answer_carries_the_security_headers() {
    let address = start(files);
    for path in ["/", "/worker.js", "/nowhere", "/api/v1/health", "/api/v1/nowhere"] {
        let answer = get(address, path);
        assert!(answer.header("content-security-policy").contains("frame-ancestors 'none'"), "{path}");
        assert_eq!(answer.header("x-content-type-options"), "nosniff", "{path}");
        assert_eq!(answer.header("referrer-policy"), "no-referrer", "{path}");
    }
}

#[test]
fn a_compressed_copy_goes_to_who_accepts_it() {
    let address = start(files);
    let path = "/app-9c0f3a1be2d45768_bg.wasm";
    let plain = get(address, path);
    assert_eq!((plain.body.as_str(), plain.header("content-encoding")), ("\0asm plain", ""));
    assert_eq!(plain.header("content-type"), "application/wasm");
    assert_eq!(plain.header("cache-control"), "public, max-age=31536000, immutable");
    assert_eq!(plain.header("vary"), "accept-encoding");

    let compressed = request(address, "GET", path, &[("accept-encoding", "gzip, br")]);
    assert_eq!((compressed.body.as_str(), compressed.header("content-encoding")), ("compressed", "br"));
    assert_eq!(compressed.header("content-type"), "application/wasm");
    assert_ne!(compressed.header("etag"), plain.header("etag"));
}

#[test]
fn what_the_browser_has_is_not_sent_again() {
    let address = start(files);
    let first = get(address, "/worker.js");
    assert_eq!((first.body.as_str(), first.header("cache-control")), ("work()", "no-cache"));
    let again = request(address, "GET", "/worker.js", &[("if-none-match", first.header("etag"))]);
    assert_eq!((again.status, again.body.as_str()), (304, ""));
    assert_eq!(again.header("etag"), first.header("etag"));
    let changed = request(address, "GET", "/worker.js", &[("if-none-match", "\"other\"")]);
    assert_eq!((changed.status, changed.body.as_str()), (200, "work()"));
}

#[test]
fn samples_are_served() {
    let sample = get(start(files), "/samples/tower/demo_00.csv");
    assert_eq!((sample.status, sample.body.as_str()), (200, "x\n1\n"));
    assert_eq!(sample.header("content-type"), "text/csv; charset=utf-8");
}

#[test]
fn what_is_not_there_is_said_on_a_page_and_below_api_in_json() {
    let address = start(files);
    let page = get(address, "/nowhere");
    assert_eq!((page.status, page.header("content-type")), (404, "text/html; charset=utf-8"));
    assert!(page.body.contains("nothing at this address"));
    let json = get(address, "/api/v1/nowhere");
    assert_eq!((json.status, json.header("content-type")), (404, "application/json"));
    assert_eq!(get(address, "/../Cargo.toml").status, 404);
    assert_eq!(request(address, "POST", "/", &[("content-length", "0")]).status, 405);
    let head = request(address, "HEAD", "/worker.js", &[]);
    assert_eq!((head.status, head.body.as_str(), head.header("content-length")), (200, "", "6"));
}

#[test]
fn without_the_app_the_page_says_how_it_is_built() {
    let page = get(start(no_files), "/");
    assert_eq!(page.status, 503);
    assert!(page.body.contains("cargo xtask run"), "{}", page.body);
}

#[test]
fn health_tells_the_version() {
    let health = get(start(no_files), "/api/v1/health");
    let json: serde_json::Value = serde_json::from_str(&health.body).unwrap();
    assert_eq!(json, serde_json::json!({"status": "ok", "version": env!("CARGO_PKG_VERSION")}));
}

#[test]
fn only_this_computer_may_connect() {
    let bench = Bench::new();
    let line = "error: --listen 0.0.0.0:0: other computers could connect, and there is nothing yet to tell who may; use 127.0.0.1";
    bench.fail(&["serve", "--listen", "0.0.0.0:0"], 2, &[line]);
    let line = "error: --listen here: expected an address and a port, such as 127.0.0.1:7700";
    bench.fail(&["serve", "--listen", "here"], 2, &[line]);
}

#[test]
fn a_taken_port_is_said() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let line = format!(
        "{address}: another program listens there; choose another port with --listen, or end that program"
    );
    Bench::new().fail(&["serve", "--listen", &address], 1, &[&line]);
}

#[cfg(unix)]
#[test]
fn the_program_tells_its_address_and_stops_when_told_to() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};

    let mut server = Command::new(env!("CARGO_BIN_EXE_goalgraph"))
        .args(["serve", "--listen", "localhost:0"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(server.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
    let address = line.strip_prefix("Goalgraph is at http://").unwrap().split('/').next().unwrap();
    assert_eq!(get(address.parse().unwrap(), "/api/v1/health").status, 200);
    // A connection that is kept open does not keep the program.
    let _idle = TcpStream::connect(address).unwrap();
    let told = Command::new("kill").arg(server.id().to_string()).status().unwrap();
    assert!(told.success());
    assert_eq!(server.wait().unwrap().code(), Some(0));
}
