//! Runs and what was reported of them.

use axum::Json;
use axum::extract::State;
use goalgraph::protocol::api::{Page, StoredEvent};
use goalgraph::protocol::monitor::RunView;
use serde::Deserialize;
use utoipa::IntoParams;

use super::Api;
use super::extract::{PathParts, QueryParts};
use super::problem::{ApiError, ApiResult};
use crate::clock::rfc3339;
use crate::store::{EventRow, MAX_PAGE, PageRequest, RunFilter};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The addresses of this module.
pub(super) fn routes() -> OpenApiRouter<Api> {
    OpenApiRouter::new().routes(routes!(list_runs)).routes(routes!(read_run)).routes(routes!(list_events))
}

/// Which runs.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
struct RunQuery {
    /// Only runs of this specification.
    specification: Option<String>,
    /// `next` of the part before; left out for the first.
    after: Option<String>,
    /// How many items at most.
    #[param(minimum = 1, maximum = 500)]
    limit: Option<u32>,
}

/// The runs, the newest first.
#[utoipa::path(get, path = "/runs", tag = "runs", params(RunQuery), responses((status = 200, body = Page<RunView>)))]
async fn list_runs(
    State(api): State<Api>,
    QueryParts(query): QueryParts<RunQuery>,
) -> ApiResult<Json<Page<RunView>>> {
    let limit = query.limit.unwrap_or(PageRequest::default().limit).clamp(1, MAX_PAGE);
    let page = PageRequest { after: query.after, limit };
    let filter = RunFilter { specification: query.specification, open_only: false };
    let runs = api.relay.runs(&filter, &page).await?;
    Ok(Json(Page { items: runs.rows, next: runs.next }))
}

/// One run as it is now.
#[utoipa::path(get, path = "/runs/{run}", tag = "runs", params(("run" = String, Path)),
    responses((status = 200, body = RunView)))]
async fn read_run(State(api): State<Api>, PathParts(run): PathParts<String>) -> ApiResult<Json<RunView>> {
    Ok(Json(api.relay.run(&run).await?))
}

/// Which events.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
struct EventQuery {
    /// Only events after the one with this number.
    after: Option<u64>,
    /// How many at most.
    #[param(minimum = 1, maximum = 500)]
    limit: Option<u32>,
}

/// The events of a run, in order.
#[utoipa::path(get, path = "/runs/{run}/events", tag = "runs", params(("run" = String, Path), EventQuery),
    responses((status = 200, body = Page<StoredEvent>)))]
async fn list_events(
    State(api): State<Api>,
    PathParts(run): PathParts<String>,
    QueryParts(query): QueryParts<EventQuery>,
) -> ApiResult<Json<Page<StoredEvent>>> {
    let limit = query.limit.unwrap_or(MAX_PAGE).clamp(1, MAX_PAGE);
    let rows = api.store.events(&run, query.after.unwrap_or(0), limit).await?;
    let is_full = rows.len() >= limit as usize;
    let next = rows.last().filter(|_| is_full).map(|last| last.number.to_string());
    let items = rows.iter().map(stored).collect::<ApiResult<_>>()?;
    Ok(Json(Page { items, next }))
}

fn stored(row: &EventRow) -> ApiResult<StoredEvent> {
    let happened = serde_json::from_str(&row.event).map_err(|error| ApiError::broken(&error))?;
    Ok(StoredEvent {
        number: row.number,
        stored_at: rfc3339(row.received_at_ms),
        happened_at: row.robot_at_ms.map(rfc3339),
        happened,
    })
}
