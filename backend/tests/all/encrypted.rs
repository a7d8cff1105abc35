//! The server with a certificate.

use std::fs;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use rustls::pki_types::{CertificateDer, ServerName};
use rustls::{ClientConfig, ClientConnection, RootCertStore, StreamOwned};

use crate::program::Program;
use crate::support::Bench;

/// Writes a certificate for localhost and its key, and returns what trusts it.
fn certificate(folder: &Path) -> CertificateDer<'static> {
    let made = rcgen::generate_simple_self_signed(["localhost".to_owned()]).unwrap();
    fs::write(folder.join("cert.pem"), made.cert.pem()).unwrap();
    fs::write(folder.join("key.pem"), made.signing_key.serialize_pem()).unwrap();
    made.cert.der().clone()
}

fn start(folder: &Path) -> Program {
    let [cert, key] = ["cert.pem", "key.pem"].map(|name| folder.join(name).display().to_string());
    Program::with(&folder.join("kept"), &["--tls-certificate", &cert, "--tls-key", &key])
}

#[test]
fn answers_are_encrypted_and_tell_browsers_to_stay_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let trusted = certificate(folder.path());
    let server = start(folder.path());
    let mut roots = RootCertStore::empty();
    roots.add(trusted).unwrap();
    let provider = Arc::new(rustls::crypto::ring::default_provider());
    let config = ClientConfig::builder_with_provider(provider).with_safe_default_protocol_versions().unwrap();
    let config = config.with_root_certificates(roots).with_no_client_auth();
    let name = ServerName::try_from("localhost").unwrap();
    let connection = ClientConnection::new(Arc::new(config), name).unwrap();
    let mut stream = StreamOwned::new(connection, TcpStream::connect(server.address).unwrap());
    stream.write_all(b"GET /api/v1/health HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n").unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    assert!(answer.contains("strict-transport-security: max-age="), "{answer}");
    // Whoever speaks in the clear is not answered.
    assert!(server.send("GET", "/api/v1/health", &[], "").is_none());
}

#[test]
fn an_executor_connects_to_a_certificate_that_it_is_told_to_trust() {
    let folder = tempfile::tempdir().unwrap();
    certificate(folder.path());
    let server = start(folder.path());
    let url = format!("wss://localhost:{}", server.address.port());
    let executor = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_goalgraph"));
        command.args(["executor", "--once", "--url", &url]).args(arguments).current_dir(folder.path());
        command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        command.spawn().unwrap()
    };
    let refused = executor(&[]).wait_with_output().unwrap();
    assert_eq!(refused.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("certificate"), "{refused:?}");

    let mut trusting = executor(&["--ca", "cert.pem"]);
    let mut heard = [0; 1];
    // It says that it is connected, and waits for an approval that does not come.
    trusting.stdout.as_mut().unwrap().read_exact(&mut heard).unwrap();
    assert!(trusting.try_wait().unwrap().is_none());
    trusting.kill().unwrap();
    trusting.wait().unwrap();
}

#[test]
fn a_certificate_that_cannot_be_used_is_said() {
    let bench = Bench::new();
    bench.write("cert.pem", "nothing");
    bench.write("key.pem", "nothing");
    let arguments = ["serve", "--listen", "127.0.0.1:0", "--data", "kept", "--tls-certificate", "cert.pem"];
    let ended = bench.run(&[&arguments[..], &["--tls-key", "key.pem"]].concat());
    assert_eq!(ended.status, 1);
    assert!(ended.stderr.starts_with("cert.pem"), "{}", ended.stderr);
    assert_eq!(ended.stderr.lines().count(), 1, "{}", ended.stderr);
    assert_eq!(bench.run(&arguments).status, 2);
}
