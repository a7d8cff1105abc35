import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { expect, type Page, test } from "@playwright/test";
import { cancelOnceBusy, drop, exported, forgetWork } from "./page";
import { type Recording, recording, repeated } from "./recordings";

const goalgraph = resolve(import.meta.dirname, process.env.GOALGRAPH_BIN ?? "../target/debug/goalgraph");

const orders = [["red", "yellow"], ["yellow", "red"]];
const eight = () => Array.from({ length: 8 }, (_, index) => recording(`${index}.csv`, orders[index % 2], index + 1));

/** What the command line writes for recordings. */
function written(files: Recording[]): string {
  const folder = mkdtempSync(join(tmpdir(), "goalgraph-workers-"));
  for (const { name, text } of files) writeFileSync(join(folder, name), text);
  const specification = join(folder, "task.goalgraph.json");
  execFileSync(goalgraph, ["infer", ...files.map(({ name }) => join(folder, name)), "-o", specification]);
  return readFileSync(specification, "utf8");
}

/** Opens the app with so many workers, for which nothing is too little to be shared. */
async function openWith(page: Page, workers: number): Promise<void> {
  await forgetWork(page);
  await page.goto(`/?workers=${workers}`);
  await expect(page.getByRole("tab", { name: "Demonstrations" })).toBeVisible();
}

test("one, two and four workers give the bytes that the command line writes", async ({ page }) => {
  const expected = written(eight());
  for (const workers of [1, 2, 4]) {
    await openWith(page, workers);
    await drop(page, eight());
    await expect(page.locator("[data-state]")).toHaveCount(4);
    expect(await exported(page), `${workers} workers`).toBe(expected);
  }
});

/** Has every worker do something before anything else. */
async function beforeWorkers(page: Page, what: () => void): Promise<void> {
  await page.route("**/worker_*.js", async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: `(${what})();\n${await response.text()}` });
  });
}

/** What workers have told a channel of this page. */
async function told(page: Page): Promise<() => Promise<number>> {
  await page.evaluate(() => {
    const heard = { count: 0 };
    new BroadcastChannel("told").onmessage = () => heard.count++;
    Object.assign(window, { heard });
  });
  return () => page.evaluate(() => (window as unknown as { heard: { count: number } }).heard.count);
}

test("where no worker can be started to share with, one does all the work", async ({ page }) => {
  await beforeWorkers(page, () => {
    const { Worker: Given, name } = self;
    if (name === "hand") return;
    self.Worker = class extends Given {
      constructor(_: string | URL, options?: WorkerOptions) {
        super(`blob:${location.origin}/gone`, options);
        new BroadcastChannel("told").postMessage("started");
      }
    };
  });
  await openWith(page, 2);
  const started = await told(page);
  await drop(page, eight());
  await expect(page.locator("[data-state]")).toHaveCount(4);
  expect(await exported(page)).toBe(written(eight()));
  expect(await started()).toBeGreaterThan(0);
});

test("what a worker breaks down over is done by another, with the same result", async ({ page }) => {
  await beforeWorkers(page, () => {
    if (self.name !== "hand") return;
    let messages = 0;
    addEventListener("message", (event) => {
      messages++;
      // The first is its program, the second a task that it does.
      if (messages < 3) return;
      event.stopImmediatePropagation();
      new BroadcastChannel("told").postMessage("broken");
      throw new Error("broken down");
    });
  });
  await openWith(page, 2);
  const broken = await told(page);
  await drop(page, eight());
  await expect(page.locator("[data-state]")).toHaveCount(4);
  expect(await exported(page)).toBe(written(eight()));
  expect(await broken()).toBeGreaterThan(3);
});

test("the progress of a shared inference goes up once, and says nothing of nothing", async ({ page }) => {
  await page.addInitScript(noteProgress);
  await openWith(page, 2);
  await drop(page, eight());
  await expect(page.locator("[data-state]")).toHaveCount(4);
  const first = await progress(page);
  expect(first.map(({ stage }) => stage)).toContain("Looking at 2 subsets");
  expect(first.map(({ stage }) => stage)).toContain("Clustering 2 subsets");
  expect(first.map(({ done }) => done)).toEqual([0, 1, 2, 2, 3, 4]);
  expect(new Set(first.map(({ total }) => total))).toEqual(new Set([5]));

  await page.getByRole("tab", { name: "Sub-goals" }).click();
  await page.getByRole("slider").focus();
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  await expect.poll(async () => (await progress(page)).slice(first.length)).toEqual([
    { stage: "Clustering 1 subset", done: 3, total: 5 },
    { stage: "Clustering 1 subset", done: 4, total: 5 },
  ]);
});

type Step = { stage: string; done: number; total: number };

/** Wraps the page's workers: what they say of how far they are, without the rehearsal. */
function noteProgress(): void {
  const steps: Step[] = [];
  window.Worker = class extends Worker {
    constructor(url: string | URL, options?: WorkerOptions) {
      super(url, options);
      this.addEventListener("message", ({ data }) => {
        if (!(data instanceof Uint8Array)) return;
        const found = /Progress.\xa5stage.(.*)\xa4done(.)\xa5total(.)$/s.exec(new TextDecoder("latin1").decode(data));
        if (found) steps.push({ stage: found[1], done: found[2].charCodeAt(0), total: found[3].charCodeAt(0) });
      });
    }
  };
  Object.assign(window, { steps });
}

const progress = (page: Page) => page.evaluate(() => (window as unknown as { steps: Step[] }).steps);

test("one more recording joins those that were shared out", async ({ page }) => {
  await openWith(page, 2);
  const files = Array.from({ length: 3 }, (_, index) => recording(`${index}.csv`, ["red", "yellow"], index + 1));
  await drop(page, files);
  await expect(page.locator("[data-state]")).toHaveCount(3);
  await drop(page, [recording("3.csv", ["yellow", "red"], 4)]);
  await expect(page.locator("[data-state]")).toHaveCount(4);
});

test("what was shared out is canceled, and learned when it is asked for again", async ({ page }) => {
  page.on("pageerror", (error) => expect.soft(error.message, "an error in the page").toBe(""));
  await openWith(page, 2);
  const slow = Array.from({ length: 20 }, (_, index) => repeated(recording(`${index}.csv`, orders[index % 2], index), 60));
  await cancelOnceBusy(page);
  await drop(page, slow);
  await expect(page.getByRole("status")).toContainText("Canceled");
  await expect(page.getByRole("progressbar", { name: "Progress" })).toBeHidden();
  await expect(page.locator("[data-file]")).toHaveCount(20);
  await expect(page.locator("[data-state]")).toHaveCount(0);

  await page.getByRole("button", { name: "Infer" }).first().click();
  await page.getByRole("tab", { name: "Automaton" }).click();
  await expect(page.locator("[data-state]")).toHaveCount(4);
});
