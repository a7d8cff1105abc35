//! A worker of the pool: does one task after the other.

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::MessageEvent;

use super::parcel::Parcel;
use super::task::{Done, Task};
use super::{file, scope};
use crate::protocol::decode;

/// Starts to listen to the coordinator, and says so.
pub(super) fn start() {
    let on_message = Closure::<dyn FnMut(MessageEvent)>::new(|event: MessageEvent| {
        let parcel = Parcel::of_message(&event.data());
        spawn_local(async move { post(&serve(&parcel).await) });
    });
    scope().set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    on_message.forget();
    let _ = scope().post_message(&JsValue::NULL);
}

/// Does a task.
pub(super) async fn serve(parcel: &Parcel) -> Parcel {
    let (done, values) = match decode::<Task>(&parcel.head) {
        Ok(Task::Read { name }) => Done::reading(match &parcel.file {
            Some(file) => file::load(file).await.and_then(|loaded| loaded.content(&name)),
            None => Err("there is no file beside the request".to_owned()),
        }),
        Ok(Task::Infer(piece)) => (Done::Inferred(piece.perform(&parcel.values)), Vec::new()),
        Err(reason) => (Done::Refused(reason), Vec::new()),
    };
    Parcel::new(&done, values)
}

fn post(parcel: &Parcel) {
    let (message, owned) = parcel.message();
    // Bytes and numbers always can be posted.
    let _ = scope().post_message_with_transfer(&message, &owned);
}
