//! What Prometheus is told.

use std::sync::Arc;
use std::time::Instant;

use axum::extract::{MatchedPath, Request, State};
use axum::http::Method;
use axum::http::header::CONTENT_TYPE;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use prometheus_client::encoding::EncodeLabelSet;
use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::{Histogram, exponential_buckets};
use prometheus_client::registry::{Registry, Unit};

use crate::relay::Relay;

/// What of a request is counted.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct Labels {
    method: String,
    /// The address with its variable parts unfilled: few, whatever is asked for.
    route: String,
    status: u16,
}

/// The counters.
pub(crate) struct Metrics {
    requests: Family<Labels, Counter>,
    durations: Histogram,
}

impl Metrics {
    /// Nothing was counted yet.
    pub(crate) fn new() -> Self {
        let buckets = exponential_buckets(0.000_5, 2.0, 16);
        Self { requests: Family::default(), durations: Histogram::new(buckets) }
    }

    /// The text that Prometheus reads.
    fn text(&self, relay: &Relay) -> Result<String, std::fmt::Error> {
        let mut registry = Registry::with_prefix("goalgraph");
        registry.register("http_requests", "HTTP requests answered", self.requests.clone());
        registry.register_with_unit(
            "http_request_duration",
            "Time until a request was answered",
            Unit::Seconds,
            self.durations.clone(),
        );
        let counts = relay.counts();
        let now = [
            ("executors_connected", "Executors connected now", counts.executors),
            ("monitors_connected", "Pages that watch now", counts.monitors),
        ];
        for (name, help, count) in now {
            let gauge = Gauge::<i64>::default();
            gauge.set(i64::try_from(count).unwrap_or(i64::MAX));
            registry.register(name, help, gauge);
        }
        let ever = [
            ("run_events_stored", "Events of runs stored since the start", counts.events_stored),
            (
                "executor_messages_refused",
                "Messages of executors refused since the start",
                counts.messages_refused,
            ),
        ];
        for (name, help, count) in ever {
            let counter = Counter::<u64>::default();
            counter.inc_by(count);
            registry.register(name, help, counter);
        }
        let mut text = String::new();
        encode(&mut text, &registry)?;
        Ok(text)
    }
}

/// Counts a request and how long it took.
pub(super) async fn count(State(metrics): State<Arc<Metrics>>, request: Request, next: Next) -> Response {
    let route = request.extensions().get::<MatchedPath>();
    let route = route.map_or("file", MatchedPath::as_str).to_owned();
    let method = known(request.method()).to_owned();
    let begun = Instant::now();
    let response = next.run(request).await;
    let status = response.status().as_u16();
    metrics.requests.get_or_create(&Labels { method, route, status }).inc();
    metrics.durations.observe(begun.elapsed().as_secs_f64());
    response
}

/// The method, or one word for all that nobody has heard of: whatever is asked, there are few counters.
fn known(method: &Method) -> &str {
    match *method {
        Method::GET | Method::HEAD | Method::POST | Method::PUT | Method::DELETE | Method::OPTIONS => {
            method.as_str()
        }
        _ => "other",
    }
}

/// `GET /metrics`.
pub(super) async fn read(State((metrics, relay)): State<(Arc<Metrics>, Relay)>) -> Response {
    match metrics.text(&relay) {
        Ok(text) => {
            let media_type = "application/openmetrics-text; version=1.0.0; charset=utf-8";
            ([(CONTENT_TYPE, media_type)], text).into_response()
        }
        Err(error) => crate::api::ApiError::broken(&error).into_response(),
    }
}
