import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { expect, test } from "@playwright/test";
import { drop, openApp } from "./page";
import { threeRecordings } from "./recordings";

const goalgraph = resolve(import.meta.dirname, process.env.GOALGRAPH_BIN ?? "../target/debug/goalgraph");

test("the browser exports the bytes that the command line writes for the same files", async ({ page }) => {
  const folder = mkdtempSync(join(tmpdir(), "goalgraph-same-bytes-"));
  const files = threeRecordings();
  for (const { name, text } of files) writeFileSync(join(folder, name), text);
  const specification = join(folder, "task.goalgraph.json");
  execFileSync(goalgraph, ["infer", ...files.map(({ name }) => join(folder, name)), "-o", specification]);

  await openApp(page);
  await drop(page, files.reverse());
  await expect(page.locator("[data-state]")).toHaveCount(4);
  const [saved] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Export JSON" }).click(),
  ]);
  expect(readFileSync(await saved.path(), "utf8")).toBe(readFileSync(specification, "utf8"));
});
