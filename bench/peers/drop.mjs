// Takes turns at dropping files on the app in Chromium: from the drop until the automaton is drawn.
//
// Arguments: folder with node_modules, Chromium, address of the server, files. Every turn is a visit without earlier work,
// and begins when the page has rehearsed.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, resolve } from "node:path";
import { createInterface } from "node:readline";

const [modules, chromium, address, ...paths] = process.argv.slice(2);
const { chromium: driver } = createRequire(resolve(modules, "package.json"))("@playwright/test");
const files = paths.map((path) => ({ name: basename(path), text: readFileSync(path, "utf8") }));

// Chromium's sandbox refuses to run as root.
const args = ["--disable-gpu", "--no-first-run", ...(process.getuid?.() === 0 ? ["--no-sandbox"] : [])];
const browser = await driver.launch({ executablePath: chromium, args });

console.log("ready");
for await (const _ of createInterface({ input: process.stdin })) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  const page = await context.newPage();
  await page.goto(address);
  await page.waitForFunction(() => performance.getEntriesByName("rehearsed").length > 0);
  console.log((await page.evaluate(dropToDrawn, files)) / 1000);
  await context.close();
}
await browser.close();

/** Milliseconds from the drop event to the first state in the page, by the page's own clock. */
async function dropToDrawn(files) {
  const transfer = new DataTransfer();
  for (const { name, text } of files) transfer.items.add(new File([text], name));
  const drawn = new Promise((done) => {
    const look = () => (document.querySelector("[data-state]") ? done() : requestAnimationFrame(look));
    requestAnimationFrame(look);
  });
  const start = performance.now();
  document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
  await drawn;
  return performance.now() - start;
}
