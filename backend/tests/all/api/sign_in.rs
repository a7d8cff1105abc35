//! Tokens, sessions, origins and hosts.

use std::thread::sleep;
use std::time::{Duration, Instant};

use goalgraph::protocol::api::{Role, Session};
use serde_json::json;

use super::{create, save, specification};
use crate::http::{Answer, Server};

fn bearer(token: &str) -> (&'static str, String) {
    ("authorization", format!("Bearer {token}"))
}

fn log_in(server: &Server, token: &str) -> Answer {
    server.send_json("POST", "/api/v1/session", &[], &json!({"token": token}))
}

/// Name and value of the cookie that an answer sets.
fn cookie(answer: &Answer) -> String {
    answer.header("set-cookie").split(';').next().unwrap().to_owned()
}

#[test]
fn on_this_computer_no_token_is_needed() {
    let session: Session = Server::start().get("/api/v1/session").expect(200).json();
    assert_eq!(session, Session { name: None, role: Role::Approver, tokens_needed: false });
}

#[test]
fn without_a_token_nothing_is_told() {
    let server = Server::with_tokens();
    for path in
        ["/api/v1/specifications", "/api/v1/session", "/api/openapi.json", "/metrics", "/api/v1/monitor"]
    {
        let answer = server.get(path).expect(401);
        assert_eq!(answer.header("www-authenticate"), "Bearer", "{path}");
    }
    server.get("/api/v1/health").expect(200);
    for wrong in ["", "goalgraph_1_2", &format!("goalgraph_{}_{}", "a".repeat(32), "b".repeat(64))] {
        let (name, value) = bearer(wrong);
        server.request("GET", "/api/v1/specifications", &[(name, &value)]).expect(401);
    }
}

#[test]
fn a_role_may_what_it_may_and_no_more() {
    let server = Server::with_tokens();
    let token = |role: &str| bearer(&server.token(role, role)).1;
    let [viewer, editor, executor] = ["viewer", "editor", "executor"].map(token);
    let body = save(&specification("Blocks", &["a b"]), "somebody else");
    let post =
        |value: &str| server.send_json("POST", "/api/v1/specifications", &[("authorization", value)], &body);
    assert_eq!(
        post(&viewer).detail(403),
        "this needs a token of the role editor; the one given has the role viewer"
    );
    assert_eq!(post(&executor).status, 403);
    let made = post(&editor).expect(201);
    // Whoever has a token saves under its name, whatever else the request says.
    let entry: goalgraph::protocol::api::SpecificationEntry = made.json();
    assert_eq!(entry.head.author, "editor");
    server.request("GET", "/api/v1/specifications", &[("authorization", &viewer)]).expect(200);
    server.request("GET", "/api/v1/specifications", &[("authorization", &executor)]).expect(403);
    let path = format!("/api/v1/specifications/{}/revisions/1/approval", entry.id);
    let signature = json!({"meaning": "ok", "sha256": entry.head.sha256, "instead_of": null});
    server.send_json("POST", &path, &[("authorization", &editor)], &signature).expect(403);
    let approver = token("approver");
    server.send_json("POST", &path, &[("authorization", &approver)], &signature).expect(201);
}

#[test]
fn a_session_opens_with_a_token_and_ends_when_it_is_closed_expired_or_its_token_revoked() {
    let server = Server::with_tokens();
    let token = server.token("Ada", "editor");
    let opened = log_in(&server, &token).expect(204);
    let attributes = opened.header("set-cookie").to_owned();
    for attribute in ["HttpOnly", "SameSite=Strict", "Path=/"] {
        assert!(attributes.contains(attribute), "{attributes}");
    }
    let cookie_of = |answer: &Answer| cookie(answer);
    let ada = cookie_of(&opened);
    let asks = |cookie: &str| server.request("GET", "/api/v1/session", &[("cookie", cookie)]);
    let session: Session = asks(&ada).expect(200).json();
    assert_eq!(session, Session { name: Some("Ada".to_owned()), role: Role::Editor, tokens_needed: true });
    asks("goalgraph_session=guess").expect(401);

    server.request("DELETE", "/api/v1/session", &[("cookie", &ada)]).expect(204);
    asks(&ada).expect(401);

    let id = token.split('_').nth(1).unwrap();
    for (secret, expires_at_ms, status) in [("old", 1_000, 401), ("new", i64::MAX, 200)] {
        let hash = goalgraph_server::digest::sha256_hex(secret.as_bytes());
        server.wait(server.store.create_session(&hash, id, expires_at_ms)).unwrap();
        asks(&format!("goalgraph_session={secret}")).expect(status);
    }

    let third = cookie_of(&log_in(&server, &token).expect(204));
    asks(&third).expect(200);
    server.wait(server.store.revoke_token(id, 1)).unwrap();
    asks(&third).expect(401);
    log_in(&server, &token).expect(401);
    let executor = server.token("arm", "executor");
    log_in(&server, &executor).expect(403);
}

#[test]
fn wrong_tokens_are_slowed_down() {
    let server = Server::with_tokens();
    let statuses: Vec<u16> = (0..40).map(|_| log_in(&server, "goalgraph_x").status).collect();
    assert_eq!(statuses[0], 401);
    assert!(statuses.contains(&429), "{statuses:?}");
    // The right one is let in again after a moment.
    let right = server.token("Ada", "viewer");
    assert_eq!(log_in(&server, &right).status, 429);
    let begun = Instant::now();
    while log_in(&server, &right).status == 429 {
        assert!(begun.elapsed() < Duration::from_mins(1));
        sleep(Duration::from_millis(100));
    }
    log_in(&server, &right).expect(204);
}

#[test]
fn pages_of_other_servers_change_nothing() {
    let server = Server::start();
    let (entry, etag) = create(&server, &specification("Blocks", &["a b"]));
    let path = format!("/api/v1/specifications/{}", entry.id);
    let own = format!("http://{}", server.address);
    let delete = |headers: &[(&str, &str)]| {
        server.request("DELETE", &path, &[&[("if-match", etag.as_str())], headers].concat())
    };
    let refused = "this page is not of this server, so it may not ask for this";
    assert_eq!(delete(&[("origin", "https://evil.example")]).detail(403), refused);
    assert_eq!(delete(&[("origin", "null")]).detail(403), refused);
    assert_eq!(delete(&[("sec-fetch-site", "cross-site")]).detail(403), refused);
    let socket = [("origin", "https://evil.example"), ("connection", "upgrade"), ("upgrade", "websocket")];
    assert_eq!(server.request("GET", "/api/v1/monitor", &socket).detail(403), refused);
    delete(&[("origin", &own)]).expect(204);
}

#[test]
fn another_host_name_that_points_here_is_not_answered() {
    let server = Server::start();
    for path in ["/", "/api/v1/specifications"] {
        let detail = server.request("GET", path, &[("host", "evil.example")]).detail(421);
        assert!(detail.starts_with("without tokens this server answers only to localhost"), "{detail}");
    }
    let port = server.address.port();
    server.request("GET", "/api/v1/health", &[("host", &format!("localhost:{port}"))]).expect(200);
    Server::with_tokens().request("GET", "/api/v1/health", &[("host", "lab.example")]).expect(200);
}
