//! What the OpenAPI document says beside what the handlers say.

use goalgraph::infer::infer_words;
use goalgraph::pdfa::Semantics;
use goalgraph::protocol::api::{Problem, Save, Signature};
use serde_json::json;
use utoipa::openapi::path::Operation;
use utoipa::openapi::security::{ApiKey, ApiKeyValue, Http, HttpAuthScheme, SecurityScheme};
use utoipa::openapi::{
    ComponentsBuilder, ContentBuilder, InfoBuilder, OpenApi, OpenApiBuilder, PathItem, Ref, RefOr,
    ResponseBuilder, Schema, SecurityRequirement,
};
use utoipa::{PartialSchema, ToSchema};

use crate::access::SESSION_COOKIE;
use crate::digest::sha256_hex;

const ABOUT: &str = "\
Specifications, their revisions and approvals, executors and their runs.

Errors are problem details (RFC 9457). Lists come in parts: `next` of one part is `after` of the following one. A save \
names the revision that it builds on in `If-Match`. On the server's own computer no token is needed.";

/// The document before anything was added.
pub(super) fn about() -> OpenApi {
    let info =
        InfoBuilder::new().title("Goalgraph").version(env!("CARGO_PKG_VERSION")).description(Some(ABOUT));
    let bearer = SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer));
    let cookie = SecurityScheme::ApiKey(ApiKey::Cookie(ApiKeyValue::new(SESSION_COOKIE)));
    let components = ComponentsBuilder::new()
        .schema(Problem::name(), Problem::schema())
        .security_scheme("token", bearer)
        .security_scheme("session", cookie)
        .build();
    let ways_in = ["token", "session"].map(|name| SecurityRequirement::new(name, Vec::<String>::new()));
    let nothing = SecurityRequirement::default();
    OpenApiBuilder::new()
        .info(info.build())
        .components(Some(components))
        .security(Some([nothing].into_iter().chain(ways_in)))
        .build()
}

/// Says of every operation that it may answer with a problem.
pub(super) fn add_problems(document: &mut OpenApi) {
    for item in document.paths.paths.values_mut() {
        for operation in operations(item) {
            let schema = Ref::from_schema_name(Problem::name());
            let content = ContentBuilder::new().schema(Some(schema)).build();
            let response = ResponseBuilder::new()
                .description("Why it was not done")
                .content("application/problem+json", content)
                .build();
            operation.responses.responses.insert("default".to_owned(), response.into());
        }
    }
}

/// Shows what a save and a signature look like; both work as they are, one after the other.
pub(super) fn add_examples(document: &mut OpenApi) {
    let words = ["red", "green"].map(|sub_goal| vec![sub_goal.to_owned()]);
    let content = infer_words("Two blocks", Semantics::MaximumLikelihood, &words).to_json();
    let sha256 = sha256_hex(content.as_bytes());
    let save = json!({ "content": content, "author": "Ada", "message": "as it was learned" });
    let signature = json!({ "who": "Ada", "meaning": "for the robot", "comment": "", "sha256": sha256, "instead_of": null });
    let Some(components) = &mut document.components else { return };
    for (name, example) in [(Save::name(), save), (Signature::name(), signature)] {
        if let Some(RefOr::T(Schema::Object(schema))) = components.schemas.get_mut(name.as_ref()) {
            schema.examples = vec![example];
        }
    }
}

fn operations(item: &mut PathItem) -> impl Iterator<Item = &mut Operation> {
    let all = [&mut item.get, &mut item.put, &mut item.post, &mut item.delete];
    all.into_iter().filter_map(Option::as_mut)
}
