//! Which role an address needs.

use axum::http::Method;
use goalgraph::protocol::api::Role;

/// The role that a request needs; none when anybody may ask.
///
/// What is not named here needs a viewer to read and an editor to change, so that a new address is not open by mistake.
pub(super) fn needed(method: &Method, path: &str) -> Option<Role> {
    match path {
        "/api/v1/health" | "/api/v1/ready" | "/api/v1/session" => None,
        "/api/v1/executor" => Some(Role::Executor),
        _ if path == "/metrics" || path.starts_with("/api/") => Some(below_api(method, path)),
        // The app itself holds no secret: without a token it shows how to log in.
        _ => None,
    }
}

fn below_api(method: &Method, path: &str) -> Role {
    let reads = matches!(*method, Method::GET | Method::HEAD | Method::OPTIONS);
    let signs = ["/approval", "/revocation", "/commands"].iter().any(|end| path.ends_with(end));
    match (reads, signs) {
        (true, _) => Role::Viewer,
        (false, true) => Role::Approver,
        (false, false) => Role::Editor,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_address_needs_its_role() {
        let check = |method: Method, path: &str, expected: Option<Role>| {
            assert_eq!(needed(&method, path), expected, "{method} {path}");
        };
        check(Method::GET, "/", None);
        check(Method::GET, "/worker_bg.wasm", None);
        check(Method::GET, "/api/v1/health", None);
        check(Method::POST, "/api/v1/session", None);
        check(Method::GET, "/metrics", Some(Role::Viewer));
        check(Method::GET, "/api/v1/specifications", Some(Role::Viewer));
        check(Method::GET, "/api/openapi.json", Some(Role::Viewer));
        check(Method::GET, "/api/v1/monitor", Some(Role::Viewer));
        check(Method::PUT, "/api/v1/specifications/0", Some(Role::Editor));
        check(Method::DELETE, "/api/v1/anything/new", Some(Role::Editor));
        check(Method::POST, "/api/v1/specifications/0/revisions/1/approval", Some(Role::Approver));
        check(Method::POST, "/api/v1/specifications/0/revisions/1/revocation", Some(Role::Approver));
        check(Method::POST, "/api/v1/executors/arm/commands", Some(Role::Approver));
        check(Method::GET, "/api/v1/executor", Some(Role::Executor));
    }
}
