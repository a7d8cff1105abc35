//! Samples that come with the app: a list, and files beside it.

use leptos::prelude::*;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{File, Response};

use super::model::{Notice, Sample};
use super::update::{Action, App};

/// Asks the server which samples there are.
pub(crate) fn list(app: App) {
    spawn_local(async move {
        // A server without samples is no failure: the start screen just shows none.
        let text = text("samples/index.json").await.unwrap_or_default();
        app.model.samples.set(Some(serde_json::from_str(&text).unwrap_or_default()));
    });
}

/// Puts a sample in the place of whatever is loaded.
pub(crate) fn load(app: App, sample: Sample) {
    let load = app.next_load();
    app.act(Action::Say(Notice::calm(format!("Loading {}", sample.title))));
    spawn_local(async move {
        let loaded = files(&sample).await;
        if !app.is_last_load(load) {
            return;
        }
        match loaded {
            Ok(files) => {
                app.act(Action::Clear);
                app.act(Action::Name(sample.title));
                app.act(Action::Open(files));
            }
            Err(reason) => app.act(Action::Say(Notice::alarm(reason))),
        }
    });
}

async fn files(sample: &Sample) -> Result<Vec<(String, File)>, String> {
    let mut files = Vec::new();
    for name in &sample.files {
        let address = format!("samples/{}/{name}", sample.id);
        let bytes = bytes(&address).await.map_err(|_| format!("The server does not give {address}."))?;
        let file = File::new_with_buffer_source_sequence(&js_sys::Array::of1(&bytes), name);
        files.push((name.clone(), file.map_err(|_| format!("{name} cannot be kept."))?));
    }
    Ok(files)
}

async fn text(address: &str) -> Result<String, JsValue> {
    JsFuture::from(response(address).await?.text()?).await?.as_string().ok_or(JsValue::NULL)
}

/// The bytes as they are: text would lose what is no UTF-8, and a byte order mark.
async fn bytes(address: &str) -> Result<JsValue, JsValue> {
    JsFuture::from(response(address).await?.array_buffer()?).await
}

async fn response(address: &str) -> Result<Response, JsValue> {
    let response: Response = JsFuture::from(window().fetch_with_str(address)).await?.dyn_into()?;
    if response.ok() { Ok(response) } else { Err(response.status_text().into()) }
}
