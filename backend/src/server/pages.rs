//! The pages that the server writes itself.

use axum::http::StatusCode;
use axum::http::header::{CACHE_CONTROL, HeaderValue};
use axum::response::{Html, IntoResponse, Response};

/// Said at every address where there is nothing.
pub(super) fn not_found() -> Response {
    page(
        StatusCode::NOT_FOUND,
        "Not found",
        "<p>There is nothing at this address. <a href=\"/\">Open Goalgraph</a></p>",
    )
}

/// Said instead of the app when this program was compiled without it.
pub(super) fn not_built() -> Response {
    page(
        StatusCode::SERVICE_UNAVAILABLE,
        "The app was not built",
        "<p>The server runs, but this program was compiled without the app. In the project's folder,</p>\n\
         <pre>cargo xtask run</pre>\n<p>builds the app and starts a server that has it.</p>",
    )
}

fn page(status: StatusCode, title: &str, body: &str) -> Response {
    let html = format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{title} · Goalgraph</title>\n<h1>{title}</h1>\n{body}\n</html>\n"
    );
    (status, [(CACHE_CONTROL, HeaderValue::from_static("no-store"))], Html(html)).into_response()
}
