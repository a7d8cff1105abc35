import { readFile } from "node:fs/promises";
import { type Page, expect, test } from "@playwright/test";
import { cancelOnceBusy, drop, exported, openApp } from "./page";
import { recording, repeated, threeRecordings } from "./recordings";

test.beforeEach(async ({ page }) => {
  // Nothing that the page does may break its content security policy or end in an error.
  page.on("pageerror", (error) => expect.soft(error.message, "an error in the page").toBe(""));
  page.on("console", (message) => {
    if (message.type() === "error") expect.soft(message.text(), "an error on the console").toBe("");
  });
  await openApp(page);
});

test("a sample is loaded by one click, and its automaton is drawn", async ({ page }) => {
  await page.getByRole("button", { name: /^Tower/ }).click();

  await expect(page.getByRole("tab", { name: "Automaton" })).toHaveAttribute("aria-selected", "true");
  await expect(page.locator('[data-state="q0"]')).toBeVisible();
  // Red and yellow in either order, green last: five states, five transitions.
  await expect(page.locator("[data-state]")).toHaveCount(5);
  await expect(page.locator("[data-transition]")).toHaveCount(5);
  await expect(page.getByLabel("Task name")).toHaveValue("Tower");
});

test("dropped files are read, and the automaton has their counts", async ({ page }) => {
  await drop(page, threeRecordings());

  await expect(page.locator("[data-state]")).toHaveCount(4);
  const first = page.getByRole("button", { name: /^red 1 from q0 to q1, probability 0.67, 2 of 3$/ });
  await expect(first).toHaveAttribute("data-transition", "q0 g0 q1");
  await expect(page.getByRole("button", { name: "State q2, completed red 1, yellow 1", exact: true })).toBeVisible();
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  await expect(page.locator('[data-verdict="accepted"]')).toHaveCount(3);
});

test("files come in any order, through the file button too", async ({ page }) => {
  const files = threeRecordings().map(({ name, text }) => ({ name, mimeType: "text/csv", buffer: Buffer.from(text) }));
  await page.getByLabel("Open demonstrations").setInputFiles(files.reverse());

  await expect(page.locator("[data-state]")).toHaveCount(4);
  const saved = await exported(page);
  expect(JSON.parse(saved).demonstrations.map((it: { name: string }) => it.name)).toEqual(["a.csv", "b.csv", "c.csv"]);
});

test("the inspector shows the evidence behind a transition", async ({ page }) => {
  await drop(page, threeRecordings());
  await page.locator('[data-transition="q0 g0 q1"] .name').click();

  const inspector = page.getByRole("complementary", { name: "Inspector" });
  await expect(inspector).toContainText("2 of 3");
  await expect(inspector).toContainText("2 demonstrations pass here");
  await expect(inspector.getByRole("listitem").filter({ hasText: /^[ab]\.csv/ })).toHaveCount(2);
  await expect(inspector.getByText("c.csv")).toHaveCount(0);
});

test("the same content is there as a table", async ({ page }) => {
  await drop(page, threeRecordings());
  await page.getByRole("button", { name: "Show as table" }).click();

  await expect(page.getByRole("table", { name: "States" }).getByRole("row")).toHaveCount(5);
  const row = page.getByRole("table", { name: "Transitions" }).getByRole("row").nth(1);
  await expect(row).toContainText("0.67");
  await expect(row).toContainText("2 of 3");
});

test("dragging the background pans and does not select, the wheel zooms, fit brings everything back", async ({ page }) => {
  await drop(page, threeRecordings());
  const state = page.locator('[data-state="q0"]');
  await expect(state).toBeVisible();
  const before = (await state.boundingBox())!;
  const frame = (await page.locator(".graph-frame").boundingBox())!;
  await page.mouse.move(frame.x + 10, frame.y + 10);
  await page.mouse.down();
  await page.mouse.move(frame.x + 110, frame.y + 60, { steps: 5 });
  await page.mouse.up();
  const panned = (await state.boundingBox())!;
  expect(panned.x - before.x).toBeCloseTo(100, 0);
  expect(panned.y - before.y).toBeCloseTo(50, 0);
  await expect(state).toHaveAttribute("aria-pressed", "false");

  await page.mouse.wheel(0, -300);
  await expect.poll(async () => (await state.boundingBox())!.width).toBeGreaterThan(before.width * 1.2);
  await page.getByRole("button", { name: "Fit", exact: true }).click();
  await expect.poll(async () => (await state.boundingBox())!.x).toBeCloseTo(before.x, 0);
});

test("what is unavailable changes the plan at once", async ({ page }) => {
  await drop(page, threeRecordings());
  await expect(page.locator("[data-state]")).toHaveCount(4);
  await page.getByRole("tab", { name: "Run" }).click();

  const steps = page.getByRole("list", { name: "Steps of the plan" }).getByRole("listitem");
  await expect(steps).toHaveCount(2);
  await expect(steps.first()).toContainText("red 1");
  await page.getByRole("switch", { name: "yellow 1 available" }).click();
  await expect(page.getByRole("heading", { name: "No plan" })).toBeVisible();
  await page.getByRole("switch", { name: "yellow 1 available" }).click();
  await expect(steps).toHaveCount(2);
});

test("the exported files hold the automaton on display", async ({ page }) => {
  await drop(page, threeRecordings());
  const specification = JSON.parse(await exported(page));
  expect(specification.format).toBe("goalgraph-specification");
  expect(specification.name).toBe("Untitled task");
  expect(specification.automaton.states).toHaveLength(4);

  await page.getByLabel("Task name").fill("Two blocks");
  await page.getByLabel("Task name").press("Enter");
  const dot = await download(page, "Export DOT");
  expect(dot.name).toBe("two-blocks.dot");
  expect(dot.text).toContain("digraph");
  const svg = await download(page, "Export SVG");
  expect(svg.name).toBe("two-blocks.svg");
  expect(svg.text.match(/data-state=/g)).toHaveLength(4);
});

test("the theme is changed and remembered", async ({ page }) => {
  await page.emulateMedia({ colorScheme: "light" });
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await background();
  await page.getByRole("button", { name: "Light or dark" }).click();
  await expect.poll(background).not.toBe(light);
  await page.reload();
  await expect(page.locator("html")).toHaveAttribute("data-theme", "dark");
  expect(await background()).not.toBe(light);
});

test("an inference is canceled, nothing is lost, and it can be done again", async ({ page }) => {
  // Thousands of frames per file keep the worker busy long enough to be interrupted.
  const slow = Array.from({ length: 40 }, (_, index) => repeated(recording(`${index}.csv`, ["red", "yellow"], index), 60));
  await cancelOnceBusy(page);
  await drop(page, slow);
  await expect(page.getByRole("status")).toContainText("Canceled");
  await expect(page.getByRole("progressbar", { name: "Progress" })).toBeHidden();
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  await expect(page.locator("[data-file]")).toHaveCount(40);

  await page.getByRole("button", { name: "Clear" }).click();
  await expect(page.locator("[data-file]")).toHaveCount(0);
  await drop(page, threeRecordings());
  await expect(page.locator("[data-state]")).toHaveCount(4);
});

async function download(page: Page, button: string) {
  const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: button }).click()]);
  return { name: saved.suggestedFilename(), text: await readFile(await saved.path(), "utf8") };
}

test("an expert restores a cluster that was eliminated", async ({ page }) => {
  // The same seed gives the same start places, which are eliminated.
  await drop(page, [
    recording("a.csv", ["red", "yellow"], 1),
    recording("b.csv", ["red", "yellow"], 1),
    recording("c.csv", ["yellow", "red"], 1),
  ]);
  await expect(page.locator("[data-state]")).toHaveCount(4);
  await page.getByRole("tab", { name: "Sub-goals" }).click();
  const found = page.getByRole("complementary", { name: "Sub-goals" });
  await expect(found.getByText("3 of 3 demonstrations start here")).toBeVisible();
  await expect(found.locator("[data-sub-goal]")).toHaveCount(1);

  await found.getByRole("button", { name: "Restore" }).click();
  await expect(found.locator("[data-sub-goal]")).toHaveCount(2);
  await page.getByRole("tab", { name: "Automaton" }).click();
  // Every demonstration starts at the restored place, so it comes first in every word.
  await expect(page.locator('[data-transition^="q0 "]')).toHaveCount(1);
});
