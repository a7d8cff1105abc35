//! The OpenAPI document, the page for it, and what every answer of the API is like.

use serde_json::Value;

use crate::http::Server;

#[test]
fn the_document_is_openapi_3_1_and_names_every_address() {
    let document: Value = Server::start().get("/api/openapi.json").expect(200).json();
    assert_eq!(document["openapi"], "3.1.0");
    let paths: Vec<&str> = document["paths"].as_object().unwrap().keys().map(String::as_str).collect();
    let expected = [
        "/api/v1/demonstrations/{sha256}",
        "/api/v1/executor",
        "/api/v1/executors",
        "/api/v1/executors/{name}/commands",
        "/api/v1/health",
        "/api/v1/monitor",
        "/api/v1/ready",
        "/api/v1/runs",
        "/api/v1/runs/{run}",
        "/api/v1/runs/{run}/events",
        "/api/v1/session",
        "/api/v1/specifications",
        "/api/v1/specifications/{id}",
        "/api/v1/specifications/{id}/approvals",
        "/api/v1/specifications/{id}/approved",
        "/api/v1/specifications/{id}/demonstrations",
        "/api/v1/specifications/{id}/demonstrations/{sha256}",
        "/api/v1/specifications/{id}/revisions",
        "/api/v1/specifications/{id}/revisions/{number}",
        "/api/v1/specifications/{id}/revisions/{number}/approval",
        "/api/v1/specifications/{id}/revisions/{number}/revocation",
        "/api/v1/specifications/{id}/revisions/{number}/specification",
    ];
    assert_eq!(paths, expected);
}

#[test]
fn every_operation_is_described_and_may_answer_with_a_problem() {
    let document: Value = Server::start().get("/api/openapi.json").json();
    for (path, item) in document["paths"].as_object().unwrap() {
        for (method, operation) in item.as_object().unwrap() {
            assert!(operation["summary"].is_string(), "{method} {path}");
            let problem = &operation["responses"]["default"]["content"]["application/problem+json"];
            assert_eq!(problem["schema"]["$ref"], "#/components/schemas/Problem", "{method} {path}");
        }
    }
}

#[test]
fn every_reference_in_the_document_leads_somewhere() {
    let document: Value = Server::start().get("/api/openapi.json").json();
    let mut open = vec![&document];
    let mut references = 0;
    while let Some(value) = open.pop() {
        if let Some(reference) = value.get("$ref").and_then(Value::as_str) {
            references += 1;
            assert!(document.pointer(reference.trim_start_matches('#')).is_some(), "{reference}");
        }
        open.extend(value.as_object().into_iter().flat_map(|it| it.values()));
        open.extend(value.as_array().into_iter().flatten());
    }
    assert!(references > 20, "{references}");
}

#[test]
fn the_page_for_the_document_keeps_the_content_security_policy() {
    let server = Server::start();
    let page = server.get("/api/docs/").expect(200);
    assert!(!page.text().contains("<style>"), "an inline style would not be applied");
    assert!(!page.text().contains("<script>"), "an inline script would not run");
    for file in ["swagger-ui-bundle.js", "swagger-ui.css", "swagger-initializer.js"] {
        server.get(&format!("/api/docs/{file}")).expect(200);
    }
    assert!(server.get("/api/docs/swagger-initializer.js").text().contains("/api/openapi.json"));
}

#[test]
fn long_answers_are_compressed_for_who_accepts_it() {
    let server = Server::start();
    let plain = server.get("/api/openapi.json").expect(200);
    for coding in ["gzip", "br"] {
        let answer = server.request("GET", "/api/openapi.json", &[("accept-encoding", coding)]).expect(200);
        assert_eq!(answer.header("content-encoding"), coding);
        assert!(answer.bytes.len() * 3 < plain.bytes.len(), "{coding}: {}", answer.bytes.len());
    }
}

#[test]
fn metrics_count_what_was_answered() {
    let server = Server::start();
    server.get("/api/v1/health").expect(200);
    server.get("/api/v1/specifications/nothing").expect(404);
    server.request("GET", "/", &[("host", "evil.example")]).expect(421);
    let text = server.get("/metrics").expect(200).text();
    for line in [
        "goalgraph_http_requests_total{method=\"GET\",route=\"/api/v1/health\",status=\"200\"} 1",
        "goalgraph_http_requests_total{method=\"GET\",route=\"/api/v1/specifications/{id}\",status=\"404\"} 1",
        "goalgraph_http_requests_total{method=\"GET\",route=\"file\",status=\"421\"} 1",
        "goalgraph_executors_connected 0",
        "# EOF",
    ] {
        assert!(text.lines().any(|it| it == line), "{line}\n{text}");
    }
}
