import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { performance } from "node:perf_hooks";
import { type Page, expect, test } from "@playwright/test";
import { forgetWork, openApp, rehearsed } from "./page";

// How long it takes from the drop to the drawn graph, beside the command line on the same files in the same run.
// Nothing here fails for being slow: machines differ. The ratio is what to watch.

const root = resolve(import.meta.dirname, "..");
const goalgraph = resolve(import.meta.dirname, process.env.GOALGRAPH_BIN ?? "../target/debug/goalgraph");
const RUNS = 5;

for (const folder of ["assets/samples/tower", "shared/tests/data/panda-stack-and-one"]) {
  test(`from drop to graph: ${folder}`, async ({ page }) => {
    const files = readdirSync(join(root, folder))
      .filter((name) => name.endsWith(".csv"))
      .map((name) => ({ name, text: readFileSync(join(root, folder, name), "utf8") }));
    const paths = files.map(({ name }) => join(root, folder, name));
    const inBrowser: number[] = [];
    const onCommandLine: number[] = [];
    for (let run = 0; run < RUNS; run++) {
      await forgetWork(page);
      await openApp(page);
      await rehearsed(page);
      inBrowser.push(await dropToGraph(page, files));
      onCommandLine.push(commandLine(paths));
    }
    const [browser, native] = [median(inBrowser), median(onCommandLine)];
    console.log(
      `${folder}: ${browser.toFixed(0)} ms from drop to graph, ${native.toFixed(0)} ms for goalgraph infer, ` +
        `ratio ${(browser / native).toFixed(1)} (medians of ${RUNS})`,
    );
    await expect(page.locator("[data-state]").first()).toBeVisible();
  });
}

/** Milliseconds from the drop event to the first state in the page, measured by the page's own clock. */
function dropToGraph(page: Page, files: { name: string; text: string }[]): Promise<number> {
  return page.evaluate(async (files) => {
    const transfer = new DataTransfer();
    for (const { name, text } of files) transfer.items.add(new File([text], name));
    const drawn = new Promise<void>((done) => {
      const look = () => (document.querySelector("[data-state]") ? done() : requestAnimationFrame(look));
      requestAnimationFrame(look);
    });
    const start = performance.now();
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
    await drawn;
    return performance.now() - start;
  }, files);
}

function commandLine(paths: string[]): number {
  const output = join(mkdtempSync(join(tmpdir(), "goalgraph-time-")), "task.goalgraph.json");
  const start = performance.now();
  execFileSync(goalgraph, ["infer", ...paths, "-o", output], { stdio: "ignore" });
  return performance.now() - start;
}

function median(values: number[]): number {
  return [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
}
