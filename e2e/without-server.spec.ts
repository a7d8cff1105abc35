import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, resolve } from "node:path";
import { expect, test } from "@playwright/test";
import { drop, kept } from "./page";
import { threeRecordings } from "./recordings";

const TYPES: Record<string, string> = {
  ".css": "text/css",
  ".html": "text/html",
  ".js": "text/javascript",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
};

test("where only files are handed out, everything but the server works, without an error", async ({ page }) => {
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
  page.on("pageerror", (error) => expect.soft(error.message, "an error in the page").toBe(""));
  page.on("console", (message) => {
    if (message.type() === "error") expect.soft(message.text(), "an error on the console").toBe("");
  });
  try {
    const { port } = server.address() as AddressInfo;
    await page.goto(`http://127.0.0.1:${port}/`);
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
    server.closeAllConnections();
    await new Promise((closed) => server.close(closed));
  }
});
