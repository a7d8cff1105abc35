//! The server over real sockets of this computer.

use std::net::{TcpListener, TcpStream};

use goalgraph_server::access::AccessSettings;
use goalgraph_server::server::{Asset, Assets};
use goalgraph_server::store::StoreOptions;

use crate::http::{Server, send};
use crate::support::Bench;

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

fn start(assets: Assets) -> Server {
    Server::with(assets, AccessSettings::default(), StoreOptions::default())
}

#[test]
fn the_page_allows_what_it_is_made_of_and_nothing_else() {
    let server = start(files);
    let page = server.get("/");
    assert_eq!((page.status, page.text().as_str()), (200, PAGE));
    assert_eq!(page.header("content-type"), "text/html; charset=utf-8");
    assert_eq!(page.header("cache-control"), "no-cache");
    let policy = page.header("content-security-policy");
    assert!(policy.starts_with("default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; "), "{policy}");
    assert!(policy.contains("; style-src 'self'; ") && !policy.contains("unsafe-inline"), "{policy}");

    // A browser takes the policy of this answer for the page it has kept.
    let known = server.request("GET", "/index.html", &[("if-none-match", page.header("etag"))]);
    assert_eq!((known.status, known.text().as_str()), (304, ""));
    assert_eq!(known.header("content-security-policy"), policy);
}

#[test]
fn every_answer_carries_the_security_headers() {
    let server = start(files);
    for path in ["/", "/worker.js", "/nowhere", "/api/v1/health", "/api/v1/nowhere"] {
        let answer = server.get(path);
        assert!(answer.header("content-security-policy").contains("frame-ancestors 'none'"), "{path}");
        assert_eq!(answer.header("x-content-type-options"), "nosniff", "{path}");
        assert_eq!(answer.header("referrer-policy"), "no-referrer", "{path}");
    }
}

#[test]
fn a_compressed_copy_goes_to_who_accepts_it() {
    let server = start(files);
    let path = "/app-9c0f3a1be2d45768_bg.wasm";
    let plain = server.get(path);
    assert_eq!((plain.text().as_str(), plain.header("content-encoding")), ("\0asm plain", ""));
    assert_eq!(plain.header("content-type"), "application/wasm");
    assert_eq!(plain.header("cache-control"), "public, max-age=31536000, immutable");
    assert_eq!(plain.header("vary"), "accept-encoding");

    let compressed = server.request("GET", path, &[("accept-encoding", "gzip, br")]);
    assert_eq!((compressed.text().as_str(), compressed.header("content-encoding")), ("compressed", "br"));
    assert_eq!(compressed.header("content-type"), "application/wasm");
    assert_ne!(compressed.header("etag"), plain.header("etag"));
}

#[test]
fn what_the_browser_has_is_not_sent_again() {
    let server = start(files);
    let first = server.get("/worker.js");
    assert_eq!((first.text().as_str(), first.header("cache-control")), ("work()", "no-cache"));
    let again = server.request("GET", "/worker.js", &[("if-none-match", first.header("etag"))]);
    assert_eq!((again.status, again.text().as_str()), (304, ""));
    assert_eq!(again.header("etag"), first.header("etag"));
    let changed = server.request("GET", "/worker.js", &[("if-none-match", "\"other\"")]);
    assert_eq!((changed.status, changed.text().as_str()), (200, "work()"));
}

#[test]
fn samples_are_served() {
    let sample = start(files).get("/samples/tower/demo_00.csv");
    assert_eq!((sample.status, sample.text().as_str()), (200, "x\n1\n"));
    assert_eq!(sample.header("content-type"), "text/csv; charset=utf-8");
}

#[test]
fn what_is_not_there_is_said_on_a_page_and_below_api_in_json() {
    let server = start(files);
    let page = server.get("/nowhere");
    assert_eq!((page.status, page.header("content-type")), (404, "text/html; charset=utf-8"));
    assert!(page.text().contains("nothing at this address"));
    let json = server.get("/api/v1/nowhere");
    assert_eq!((json.status, json.header("content-type")), (404, "application/problem+json"));
    assert_eq!(server.get("/../Cargo.toml").status, 404);
    assert_eq!(server.request("POST", "/", &[("content-length", "0")]).status, 405);
    let head = server.request("HEAD", "/worker.js", &[]);
    assert_eq!((head.status, head.text().as_str(), head.header("content-length")), (200, "", "6"));
}

#[test]
fn without_the_app_the_page_says_how_it_is_built() {
    let page = start(no_files).get("/");
    assert_eq!(page.status, 503);
    assert!(page.text().contains("cargo xtask run"), "{}", page.text());
}

#[test]
fn health_tells_the_version() {
    let health = start(no_files).get("/api/v1/health");
    let json: serde_json::Value = serde_json::from_str(&health.text()).unwrap();
    assert_eq!(json, serde_json::json!({"status": "ok", "version": env!("CARGO_PKG_VERSION")}));
}

#[test]
fn other_computers_may_connect_only_with_tokens() {
    let bench = Bench::new();
    let lines = [
        "error: --listen 0.0.0.0:0: tokens tell who may connect, and there is none yet; make one with",
        "  goalgraph token create \"YOUR NAME\" --role approver --data kept",
    ];
    bench.fail(&["serve", "--listen", "0.0.0.0:0", "--data", "kept"], 2, &lines);
    let line = "error: --listen here: expected an address and a port, such as 127.0.0.1:7700";
    bench.fail(&["serve", "--listen", "here", "--data", "kept"], 2, &[line]);
}

#[test]
fn a_taken_port_is_said() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let line = format!(
        "{address}: another program listens there; choose another port with --listen, or end that program"
    );
    Bench::new().fail(&["serve", "--listen", &address, "--data", "kept"], 1, &[&line]);
}

#[cfg(unix)]
#[test]
fn the_program_tells_its_address_and_stops_when_told_to() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};

    let folder = tempfile::tempdir().unwrap();
    let mut server = Command::new(env!("CARGO_BIN_EXE_goalgraph"))
        .args(["serve", "--listen", "localhost:0", "--data", "kept"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(server.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
    let address = line.strip_prefix("Goalgraph is at http://").unwrap().split('/').next().unwrap();
    assert_eq!(send(address.parse().unwrap(), "GET", "/api/v1/health", &[], b"").status, 200);
    // A connection that is kept open does not keep the program.
    let _idle = TcpStream::connect(address).unwrap();
    let told = Command::new("kill").arg(server.id().to_string()).status().unwrap();
    assert!(told.success());
    assert_eq!(server.wait().unwrap().code(), Some(0));
}
