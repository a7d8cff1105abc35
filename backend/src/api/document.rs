//! What the OpenAPI document says beside what the handlers say.

use goalgraph::protocol::api::Problem;
use utoipa::openapi::path::Operation;
use utoipa::openapi::security::{ApiKey, ApiKeyValue, Http, HttpAuthScheme, SecurityScheme};
use utoipa::openapi::{
    ComponentsBuilder, ContentBuilder, InfoBuilder, OpenApi, OpenApiBuilder, PathItem, Ref, ResponseBuilder,
    SecurityRequirement,
};
use utoipa::{PartialSchema, ToSchema};

use crate::access::SESSION_COOKIE;

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

fn operations(item: &mut PathItem) -> impl Iterator<Item = &mut Operation> {
    let all = [&mut item.get, &mut item.put, &mut item.post, &mut item.delete];
    all.into_iter().filter_map(Option::as_mut)
}
