import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { expect, test } from "@playwright/test";
import { cancelOnceBusy, drop, exported, forgetWork } from "./page";
import { recording, repeated } from "./recordings";

const goalgraph = resolve(import.meta.dirname, process.env.GOALGRAPH_BIN ?? "../target/debug/goalgraph");

test("one, two and four workers give the bytes that the command line writes", async ({ page }) => {
  const orders = [["red", "yellow"], ["yellow", "red"]];
  const files = Array.from({ length: 8 }, (_, index) => recording(`${index}.csv`, orders[index % 2], index + 1));
  const folder = mkdtempSync(join(tmpdir(), "goalgraph-workers-"));
  for (const { name, text } of files) writeFileSync(join(folder, name), text);
  const specification = join(folder, "task.goalgraph.json");
  execFileSync(goalgraph, ["infer", ...files.map(({ name }) => join(folder, name)), "-o", specification]);
  const expected = readFileSync(specification, "utf8");

  for (const workers of [1, 2, 4]) {
    await forgetWork(page);
    // The number also says that nothing is too little to be shared.
    await page.goto(`/?workers=${workers}`);
    await expect(page.getByRole("tab", { name: "Demonstrations" })).toBeVisible();
    await drop(page, files);
    await expect(page.locator("[data-state]")).toHaveCount(4);
    expect(await exported(page), `${workers} workers`).toBe(expected);
  }
});

test("one more recording joins those that were shared out", async ({ page }) => {
  await forgetWork(page);
  await page.goto("/?workers=2");
  await expect(page.getByRole("tab", { name: "Demonstrations" })).toBeVisible();
  const files = Array.from({ length: 3 }, (_, index) => recording(`${index}.csv`, ["red", "yellow"], index + 1));
  await drop(page, files);
  await expect(page.locator("[data-state]")).toHaveCount(3);
  await drop(page, [recording("3.csv", ["yellow", "red"], 4)]);
  await expect(page.locator("[data-state]")).toHaveCount(4);
});

test("what was shared out is canceled, and learned when it is asked for again", async ({ page }) => {
  await forgetWork(page);
  await page.goto("/?workers=2");
  await expect(page.getByRole("tab", { name: "Demonstrations" })).toBeVisible();
  const orders = [["red", "yellow"], ["yellow", "red"]];
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
