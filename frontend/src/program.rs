//! What workers are started from. The page keeps it, so that workers start without a server too, and compile nothing.

use wasm_bindgen::prelude::*;
use web_sys::{Worker, WorkerOptions, WorkerType};

/// The program of a worker.
pub(crate) struct Program {
    /// The address of its script, which waits for the module.
    script: String,
    /// The compiled module.
    module: JsValue,
}

impl Program {
    /// The program of the worker that asks.
    pub(crate) fn own(location: &web_sys::WorkerLocation) -> Self {
        Self { script: location.href(), module: wasm_bindgen::module() }
    }

    /// Starts a worker that is called `name`.
    ///
    /// # Errors
    ///
    /// When the browser starts none.
    pub(crate) fn start(&self, name: &str) -> Result<Worker, JsValue> {
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        options.set_name(name);
        let worker = Worker::new_with_options(&self.script, &options)?;
        worker.post_message(&self.module)?;
        Ok(worker)
    }
}

#[cfg(feature = "page")]
mod fetched {
    use futures_util::future::try_join;
    use js_sys::{Array, Promise, Uint8Array, WebAssembly};
    use leptos::prelude::window;
    use wasm_bindgen::prelude::*;
    use wasm_bindgen_futures::JsFuture;
    use web_sys::{Blob, BlobPropertyBag, Response, Url};

    use super::Program;

    /// A module of one function that fills a vector and drops it.
    const VECTORS: [u8; 29] = [
        0, 97, 115, 109, 1, 0, 0, 0, // magic and version
        1, 4, 1, 96, 0, 0, // a type: nothing to nothing
        3, 2, 1, 0, // a function of it
        10, 9, 1, 7, 0, 65, 0, 253, 15, 26, 11, // i32.const 0, i8x16.splat, drop, end
    ];

    /// What the script does with the module that it is given: its own function makes a worker of it.
    const START: &str = "\nonmessage = ({ data: module }) => initSync({ module });\n";

    impl Program {
        /// Fetches the program from where the page is from: the build with SIMD where the browser has it, else the one
        /// without.
        ///
        /// # Errors
        ///
        /// When it is not there or the browser cannot compile it.
        pub(crate) async fn fetch() -> Result<Self, JsValue> {
            let vectors = WebAssembly::validate(&Uint8Array::from(VECTORS.as_slice()))?;
            let build = if vectors { "worker_simd" } else { "worker_plain" };
            let (script, module) = try_join(script(build), module(build)).await?;
            Ok(Self { script, module })
        }
    }

    async fn script(build: &str) -> Result<String, JsValue> {
        let text = JsFuture::from(response(&format!("/{build}.js")).await?.text()?).await?;
        let kind = BlobPropertyBag::new();
        kind.set_type("text/javascript");
        let parts = Array::of2(&text, &START.into());
        Url::create_object_url_with_blob(&Blob::new_with_str_sequence_and_options(&parts, &kind)?)
    }

    async fn module(build: &str) -> Result<JsValue, JsValue> {
        let path = format!("/{build}_bg.wasm");
        let fetched: Promise = window().fetch_with_str(&path);
        if let Ok(module) = JsFuture::from(WebAssembly::compile_streaming(&fetched)).await {
            return Ok(module);
        }
        // Browsers compile on the way only what says that it is WebAssembly; not every server says so.
        let bytes = JsFuture::from(response(&path).await?.array_buffer()?).await?;
        JsFuture::from(WebAssembly::compile(&bytes)).await
    }

    async fn response(path: &str) -> Result<Response, JsValue> {
        let response: Response = JsFuture::from(window().fetch_with_str(path)).await?.unchecked_into();
        if response.ok() { Ok(response) } else { Err(path.into()) }
    }
}
