//! The content security policy: what a page of ours may load and run.

use axum::http::HeaderValue;

/// Everything from this server, nothing from elsewhere, no inline script or style. Workers are started from what the page
/// has kept of this server: a worker is bound to the policy of the page.
pub(super) const POLICY: HeaderValue = HeaderValue::from_static(
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; \
     connect-src 'self'; worker-src blob:; object-src 'none'; base-uri 'none'; frame-ancestors 'none'; \
     form-action 'none'",
);
