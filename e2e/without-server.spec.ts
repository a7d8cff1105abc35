import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, resolve } from "node:path";
import { expect, type Page, test } from "@playwright/test";
import { cancelOnceBusy, countWorkers, drop, exported, forgetWork, kept, openApp, rehearsed } from "./page";
import { recording, repeated, threeRecordings } from "./recordings";

const TYPES: Record<string, string> = {
  ".css": "text/css",
  ".html": "text/html",
  ".js": "text/javascript",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
};

/** Hands out the files of the app, and nothing else. */
async function handOut(): Promise<{ url: string; close: () => Promise<void> }> {
  const dist = resolve(import.meta.dirname, "../dist");
  const server = createServer(async (request, response) => {
    const path = new URL(request.url ?? "/", "http://localhost").pathname;
    try {
      const content = await readFile(join(dist, path === "/" ? "index.html" : path));
      response.writeHead(200, { "content-type": TYPES[extname(path) || ".html"] ?? "application/octet-stream" }).end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise<void>((listening) => server.listen(0, "127.0.0.1", listening));
  const close = async () => {
    server.closeAllConnections();
    await new Promise((closed) => server.close(closed));
  };
  return { url: `http://127.0.0.1:${(server.address() as AddressInfo).port}/`, close };
}

/** Nothing that the page does ends in an error. */
function expectNoErrors(page: Page): void {
  page.on("pageerror", (error) => expect.soft(error.message, "an error in the page").toBe(""));
  page.on("console", (message) => {
    if (message.type() === "error") expect.soft(message.text(), "an error on the console").toBe("");
  });
}

test("where only files are handed out, everything but the server works, without an error", async ({ page }) => {
  const server = await handOut();
  expectNoErrors(page);
  try {
    await page.goto(server.url);
    await expect(page.getByRole("tab", { name: "Demonstrations" })).toBeVisible();
    await drop(page, threeRecordings());
    await expect(page.locator("[data-state]")).toHaveCount(4);
    await expect(page.locator(".standing")).toHaveText("In this browser");
    const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
    expect(saved.suggestedFilename()).toMatch(/\.goalgraph\.json$/);
    await kept(page);
    await page.reload();
    await expect(page.locator("[data-state]")).toHaveCount(4);
  } finally {
    await server.close();
  }
});

test("workers start without the server that the page came from", async ({ page }) => {
  const orders = [["red", "yellow"], ["yellow", "red"]];
  const large = Array.from({ length: 8 }, (_, index) => repeated(recording(`${index}.csv`, orders[index % 2], index), 300));
  const workers = await countWorkers(page);
  const server = await handOut();
  expectNoErrors(page);
  await page.goto(`${server.url}?workers=2`);
  await rehearsed(page);
  await server.close();

  await cancelOnceBusy(page);
  await drop(page, large);
  await expect(page.getByRole("status")).toContainText("Canceled");
  await page.getByRole("button", { name: "Infer" }).first().click();
  await page.getByRole("tab", { name: "Automaton" }).click();
  await expect(page.locator("[data-state]")).toHaveCount(4);
  expect(JSON.parse(await exported(page)).demonstrations).toHaveLength(8);
  expect(await workers()).toBe(2);
});

test("a worker that does not start is said once and tried again with the next request, and nothing is lost", async ({ page }) => {
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  let tries = 0;
  const refuse = "**/worker_*";
  await page.route(refuse, async (route) => {
    if (route.request().url().endsWith(".js")) tries++;
    await route.abort();
  });
  await forgetWork(page);
  await openApp(page);
  await expect(page.getByRole("status")).toContainText("the worker did not start");
  await drop(page, threeRecordings());
  await expect(page.locator('[data-verdict="canceled"]')).toHaveCount(3);
  await page.waitForTimeout(1000);
  expect(tries).toBe(2);

  await page.unroute(refuse);
  for (const name of ["a.csv", "b.csv", "c.csv"]) {
    await page.locator(`[data-file="${name}"]`).getByRole("button", { name: "Read again" }).click();
  }
  await page.getByRole("tab", { name: "Automaton" }).click();
  await expect(page.locator("[data-state]")).toHaveCount(4);
  expect(errors).toEqual([]);
});
