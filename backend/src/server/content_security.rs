//! The content security policy: what a page of ours may load and run.

use axum::http::HeaderValue;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

/// Everything from this server, nothing from elsewhere, no inline script or style.
const POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
    img-src 'self' data: blob:; connect-src 'self'; worker-src 'self'; object-src 'none'; base-uri 'none'; \
    frame-ancestors 'none'; form-action 'none'";
/// What a page's own scripts are added to.
const SCRIPTS: &str = "'wasm-unsafe-eval'";

/// The policy of everything but the app's own page.
pub(super) fn policy() -> HeaderValue {
    HeaderValue::from_static(POLICY)
}

/// The policy of a page that the build made: the inline scripts in it, which start the app, may run and no others.
pub(super) fn policy_for_page(html: &[u8]) -> HeaderValue {
    let html = String::from_utf8_lossy(html);
    let digest = |script: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(script)));
    let mut sources = vec![SCRIPTS.to_owned()];
    sources.extend(inline_scripts(&html).into_iter().map(digest));
    let policy = POLICY.replace(SCRIPTS, &sources.join(" "));
    HeaderValue::try_from(policy).unwrap_or_else(|_| self::policy())
}

/// The content of every script that is written in the page itself.
fn inline_scripts(html: &str) -> Vec<&str> {
    let mut scripts = Vec::new();
    let mut rest = html;
    while let Some((_, from_tag)) = rest.split_once("<script")
        && let Some((attributes, from_content)) = from_tag.split_once('>')
        && let Some((content, after)) = from_content.split_once("</script>")
    {
        if !attributes.contains("src=") {
            scripts.push(content);
        }
        rest = after;
    }
    scripts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_in_the_page_are_told_from_those_it_loads() {
        let html = r#"<head><script type="module">start()</script><script src="/a.js"></script></head><script>b</script>"#;
        assert_eq!(inline_scripts(html), ["start()", "b"]);
        assert!(inline_scripts("<p>no script</p><script>never closed").is_empty());
    }

    #[test]
    fn a_page_allows_its_own_scripts_by_their_digest() {
        let policy = policy_for_page(b"<script>alert('Hello, world.');</script>");
        let digest = "'sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng='";
        assert!(policy.to_str().unwrap().contains(&format!("'wasm-unsafe-eval' {digest};")));
        assert_eq!(policy_for_page(b"<p>plain</p>"), super::policy());
    }
}
