// Takes turns at the workloads of goalgraph-bench as WebAssembly, in Chromium.
//
// Arguments: folder with node_modules, Chromium, folder of the module. An order is a workload, its cloud where it has one,
// and its size: `cluster rests 100000`, `read 10`. It is prepared when it is first asked for.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";

const [modules, chromium, folder] = process.argv.slice(2);
const { chromium: driver } = createRequire(resolve(modules, "package.json"))("@playwright/test");

// Chromium's sandbox refuses to run as root.
const args = ["--disable-gpu", "--no-first-run", ...(process.getuid?.() === 0 ? ["--no-sandbox"] : [])];
const browser = await driver.launch({ executablePath: chromium, args });
const page = await browser.newPage();
const bytes = readFileSync(join(folder, "goalgraph_bench_bg.wasm")).toString("base64");
// Not as a script of the page: its glue then asks for the address it was loaded from, and there is none.
const glue = readFileSync(join(folder, "goalgraph_bench.js"), "utf8");
await page.evaluate(`${glue}\nwindow.bench = wasm_bindgen;\n0`);
await page.evaluate(async (base64) => {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  await window.bench({ module_or_path: bytes });
  window.prepared = new Map();
}, bytes);

console.log("ready");
for await (const order of createInterface({ input: process.stdin })) {
  const seconds = await page.evaluate((order) => {
    if (!window.prepared.has(order)) {
      const [workload, ...rest] = order.split(" ");
      const { Clustering, Reading } = window.bench;
      const size = Number(rest.at(-1));
      window.prepared.set(order, workload === "cluster" ? new Clustering(rest[0], size) : new Reading(size));
      // Until the compiler that optimizes is done with it.
      for (let run = 0; run < 3; run++) window.prepared.get(order).run();
    }
    const start = performance.now();
    window.prepared.get(order).run();
    return (performance.now() - start) / 1000;
  }, order);
  console.log(seconds);
}
await browser.close();
