// Starts the app. The tag of this script names the app's files, whose names change with their content.
const { js, wasm } = document.querySelector("script[data-wasm]").dataset;

// A file that is dropped before the app listens must not take the place of the page.
for (const kind of ["dragover", "drop"]) addEventListener(kind, (event) => event.preventDefault());

const { default: start } = await import(js);
await start({ module_or_path: wasm });
