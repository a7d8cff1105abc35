import { readFile } from "node:fs/promises";
import { type Locator, type Page, expect, test } from "@playwright/test";
import { drop, exported, openApp } from "./page";

/** The tower sample: red and yellow in either order, green last. */
async function openTower(page: Page): Promise<void> {
  await openApp(page);
  await page.getByRole("button", { name: /^Tower/ }).click();
  await expect(page.locator("[data-state]")).toHaveCount(5);
}

const state = (page: Page, id: string): Locator => page.locator(`[data-state="${id}"]`);
const preview = (page: Page): Locator => page.getByRole("region", { name: "Preview" });
const inspector = (page: Page): Locator => page.getByRole("complementary", { name: "Inspector" });

async function center(locator: Locator): Promise<{ x: number; y: number }> {
  const box = (await locator.boundingBox())!;
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

async function dragTo(page: Page, from: { x: number; y: number }, to: { x: number; y: number }): Promise<void> {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 4 });
  await page.mouse.move(to.x, to.y, { steps: 4 });
}

test.beforeEach(async ({ page }) => {
  page.on("pageerror", (error) => expect.soft(error.message, "an error in the page").toBe(""));
  page.on("console", (message) => {
    if (message.type() === "error") expect.soft(message.text(), "an error on the console").toBe("");
  });
});

test("a state dragged onto another one is merged after its preview", async ({ page }) => {
  await openTower(page);
  const before = await exported(page);
  await dragTo(page, await center(state(page, "q3")), await center(state(page, "q1")));
  // While the pointer is over the other state, the consequence is shown already.
  await expect(preview(page)).toContainText("Merge");
  await page.mouse.up();

  await expect(preview(page).getByRole("button", { name: "Apply" })).toBeVisible();
  await expect(preview(page)).toContainText("Folds");
  await expect(state(page, "q3"), "nothing is done yet").toBeVisible();
  expect(await exported(page), "a preview changes nothing").toBe(before);
  await preview(page).getByRole("button", { name: "Apply" }).click();

  await expect(state(page, "q3")).toHaveCount(0);
  await page.keyboard.press("Control+z");
  await expect(state(page, "q3")).toBeVisible();
  expect(await exported(page), "undo gives the same bytes").toBe(before);
  await page.keyboard.press("Control+Shift+z");
  await expect(state(page, "q3")).toHaveCount(0);
});

test("a preview that is canceled leaves no trace", async ({ page }) => {
  await openTower(page);
  const before = await exported(page);
  await state(page, "q1").click();
  await page.keyboard.press("Delete");
  await expect(preview(page)).toContainText("No longer accepted");
  await expect(preview(page)).toContainText("Demonstrations no longer accepted");
  await page.keyboard.press("Escape");

  await expect(preview(page)).toHaveCount(0);
  expect(await exported(page)).toBe(before);
  await page.getByRole("tab", { name: "History" }).click();
  await expect(page.getByRole("list", { name: "Steps" }).getByRole("listitem")).toHaveCount(1);
});

test("an edit that was begun with a button and canceled leaves no trace either", async ({ page }) => {
  await openTower(page);
  const before = await exported(page);
  const forbid = page.locator(".variant").first().getByRole("button", { name: "Forbid" });
  await forbid.focus();
  await expect(preview(page), "the focus shows what it would do").toBeVisible();
  await page.keyboard.press("Enter");
  await expect(preview(page).getByRole("button", { name: "Apply" })).toBeFocused();
  await preview(page).getByRole("button", { name: "Cancel the edit" }).click();
  await expect(preview(page)).toHaveCount(0);
  await expect(forbid).toBeFocused();
  await expect(page.locator(".transition.going")).toHaveCount(0);
  expect(await exported(page)).toBe(before);
});

test("several states are pruned and merged at once", async ({ page }) => {
  await openTower(page);
  await state(page, "q2").click();
  await page.keyboard.press("]");
  await expect(inspector(page)).toContainText("2 states selected");
  await page.keyboard.press("Delete");
  await expect(preview(page)).toContainText("Removes");
  await page.keyboard.press("Enter");
  await expect(page.locator("[data-state]")).toHaveCount(3);
  await page.keyboard.press("Control+z");
  await expect(page.locator("[data-state]")).toHaveCount(5);
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Control+m");
  await expect(preview(page)).toContainText("Folds");
  await page.keyboard.press("Enter");
  await expect(page.locator("[data-state]")).toHaveCount(1);
});

test("a step can be marked as approved, and an export marks it as saved", async ({ page }) => {
  await openTower(page);
  await exported(page);
  await page.getByRole("tab", { name: "History" }).click();
  await page.getByRole("button", { name: "Mark as approved" }).click();
  const first = page.getByRole("list", { name: "Steps" }).getByRole("listitem").first();
  await expect(first).toContainText("saved");
  await expect(first).toContainText("approved");
});

test("a transition is reweighted by mouse, and the others give way", async ({ page }) => {
  await openTower(page);
  await state(page, "q0").click();
  const field = inspector(page).getByLabel(/^Probability of/).first();
  await field.fill("0.9");
  await expect(preview(page)).toContainText("Log-likelihood");
  await preview(page).getByRole("button", { name: "Apply" }).click();

  const automaton = JSON.parse(await exported(page)).automaton;
  const out = automaton.transitions.filter((it: { source: string }) => it.source === "q0");
  expect(out.map((it: { probability: number }) => it.probability.toFixed(4))).toEqual(["0.9000", "0.1000"]);
  expect(out[0].count, "counts are evidence and stay").not.toBe(out[0].weight);
  await expect(page.locator(".transition.expert")).toHaveCount(2);
  await inspector(page).getByRole("button", { name: "Reset to counts" }).click();
  await preview(page).getByRole("button", { name: "Apply" }).click();
  await expect(page.locator(".transition.expert")).toHaveCount(0);
});

test("merge, prune and reweight by keyboard alone", async ({ page }) => {
  await openTower(page);
  await state(page, "q1").focus();
  await page.keyboard.press("Enter");
  await state(page, "q3").focus();
  await page.keyboard.press("Shift+Enter");
  await expect(inspector(page)).toContainText("2 states selected");
  await page.keyboard.press("Control+m");
  await expect(preview(page)).toContainText("Folds");
  await page.keyboard.press("Enter");
  await expect(state(page, "q3")).toHaveCount(0);
  await page.keyboard.press("Control+z");
  await expect(state(page, "q3")).toHaveCount(1);

  await state(page, "q0").focus();
  await page.keyboard.press("Enter");
  await page.keyboard.press("w");
  await expect(inspector(page).getByLabel(/^Probability of/).first()).toBeFocused();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("0.25");
  await page.keyboard.press("Enter");
  await expect(page.getByRole("status").filter({ hasText: "Reweight" })).toBeVisible();

  await page.locator("[data-transition]").first().focus();
  await page.keyboard.press("Enter");
  await page.keyboard.press("Delete");
  await expect(preview(page)).toBeVisible();
  await page.keyboard.press("Enter");
  await expect(page.locator("[data-transition]")).not.toHaveCount(5);
});

test("what makes no sense is refused with a sentence, and nothing changes", async ({ page }) => {
  await openTower(page);
  const before = await exported(page);
  await state(page, "q0").click();
  const field = inspector(page).getByLabel(/^Probability of/).first();
  for (const typed of ["NaN", "-1", "Infinity", "2", "x"]) {
    await field.fill(typed);
    await field.press("Enter");
    await expect(page.getByRole("status").filter({ hasText: "Not done" })).toBeVisible();
  }
  await state(page, "q0").click();
  await page.keyboard.press("Delete");
  await expect(preview(page)).toContainText("cannot be pruned");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Escape");
  expect(await exported(page)).toBe(before);
});

test("hostile names are names", async ({ page }) => {
  await openTower(page);
  for (const name of ["constructor", "__proto__", "<b>bold</b>", "\u202eבדיקה", "🧱🧱"]) {
    await state(page, "q1").click();
    await inspector(page).getByLabel("Name").fill(name);
    await inspector(page).getByLabel("Name").press("Enter");
    expect(JSON.parse(await exported(page)).automaton.states[1].name).toBe(name);
  }
  await inspector(page).getByLabel("Name").fill("x".repeat(10_000));
  await inspector(page).getByLabel("Name").press("Enter");
  await expect(page.getByRole("status").filter({ hasText: "Not done" })).toContainText("200");
  expect(JSON.parse(await exported(page)).automaton.states[1].name).toBe("🧱🧱");
});

test("the work survives a reload, with its history and pinned states", async ({ page }) => {
  await openTower(page);
  await state(page, "q1").click();
  await inspector(page).getByLabel(/^Accepting/).click();
  await preview(page).getByRole("button", { name: "Apply" }).click();
  const from = await center(state(page, "q2"));
  await dragTo(page, from, { x: from.x + 60, y: from.y + 40 });
  await page.mouse.up();
  await expect(page.locator(".state.held")).toHaveCount(1);
  const before = await exported(page);
  await page.waitForTimeout(1000);
  await page.reload();

  await expect(page.getByRole("status").filter({ hasText: "Restored" })).toBeVisible();
  await expect(page.locator("[data-state]")).toHaveCount(5);
  await expect(page.locator(".state.held")).toHaveCount(1);
  expect(await exported(page)).toBe(before);
  await page.keyboard.press("Control+z");
  await page.getByRole("tab", { name: "History" }).click();
  await expect(page.locator(".steps-done .undone")).toHaveCount(1);
  // The recordings are back as well: nothing has to be learned again.
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  await expect(page.locator('[data-verdict="accepted"]')).toHaveCount(9);
});

test("work that was cleared, or replaced by a sample, can be brought back", async ({ page }) => {
  await openTower(page);
  await state(page, "q1").click();
  await page.keyboard.press("a");
  await preview(page).getByRole("button", { name: "Apply" }).click();
  const before = await exported(page);
  await page.keyboard.press("Control+k");
  await page.keyboard.type("load sample: two stacks");
  await page.keyboard.press("Enter");
  await expect(page.locator("[data-state]")).toHaveCount(9);
  await page.keyboard.press("Control+k");
  await page.keyboard.type("bring back");
  await page.keyboard.press("Enter");
  await expect(page.locator("[data-state]")).toHaveCount(5);
  expect(await exported(page)).toBe(before);
  await page.keyboard.press("Control+z");
  await page.getByRole("tab", { name: "History" }).click();
  await expect(page.locator(".steps-done .undone")).toHaveCount(1);
});

test("saved work of another version is kept aside and said", async ({ page }) => {
  await openTower(page);
  await page.waitForTimeout(1000);
  await page.evaluate(
    () =>
      new Promise<void>((resolve, reject) => {
        const opening = indexedDB.open("goalgraph", 1);
        opening.onerror = () => reject(opening.error);
        opening.onsuccess = () => {
          const transaction = opening.result.transaction("work", "readwrite");
          transaction.objectStore("work").put('{"format":"goalgraph-work","version":99,"more":true}', "current");
          transaction.oncomplete = () => {
            opening.result.close();
            resolve();
          };
        };
      }),
  );
  await page.reload();

  await expect(page.getByRole("status").filter({ hasText: "version 99" })).toBeVisible();
  await page.keyboard.press("Control+k");
  await page.keyboard.type("kept aside");
  const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Enter")]);
  expect(await readFile(await saved.path(), "utf8")).toContain('"version":99');
});

test("pinned states stay where they are through a hundred edits", async ({ page }) => {
  await openTower(page);
  const from = await center(state(page, "q2"));
  await dragTo(page, from, { x: from.x + 50, y: from.y + 30 });
  await page.mouse.up();
  const before = await exported(page);
  const pinned = await state(page, "q2").getAttribute("style");
  await state(page, "q1").click();
  for (let times = 0; times < 50; times++) {
    await page.keyboard.press("a");
    await page.keyboard.press("Enter");
    await page.keyboard.press("Control+z");
  }
  expect(await state(page, "q2").getAttribute("style")).toBe(pinned);
  expect(await exported(page), "moving is no change of the specification").toBe(before);
});

test("a word is forbidden and added again", async ({ page }) => {
  await openTower(page);
  const variants = page.locator(".variant");
  const words = await variants.count();
  await variants.last().getByRole("button", { name: "Forbid" }).click();
  await expect(preview(page)).toContainText("No longer accepted");
  await preview(page).getByRole("button", { name: "Apply" }).click();
  await expect(page.locator('.variant[data-fits="false"]')).toHaveCount(1);
  await expect(page.locator(".fit")).toContainText("∞");
  await page.locator('.variant[data-fits="false"]').getByRole("button", { name: "Add" }).click();
  await preview(page).getByRole("button", { name: "Apply" }).click();
  await expect(page.locator('.variant[data-fits="true"]')).toHaveCount(words);
});

test("an exported specification and an exported drawing can be opened", async ({ page }) => {
  await openTower(page);
  const json = await exported(page);
  const [dot] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Export DOT" }).click(),
  ]);
  const text = await readFile(await dot.path(), "utf8");
  await page.keyboard.press("Control+k");
  await page.keyboard.type("clear");
  await page.keyboard.press("Enter");
  await expect(page.locator("[data-state]")).toHaveCount(0);

  await drop(page, [{ name: "tower.goalgraph.json", text: json }]);
  await expect(page.locator("[data-state]")).toHaveCount(5);
  expect(await exported(page)).toBe(json);
  await drop(page, [{ name: "tower.dot", text }]);
  await expect(page.getByRole("status").filter({ hasText: "tower.dot is open" })).toBeVisible();
  await expect(page.locator("[data-state]")).toHaveCount(5);
  await page.keyboard.press("Control+z");
  expect(await exported(page), "opening is a step that can be undone").toBe(json);
});

test("a specification that cannot be opened is refused with the reason, and the work stays", async ({ page }) => {
  await openTower(page);
  const before = await exported(page);
  await drop(page, [{ name: "bad.goalgraph.json", text: '{"format": "goalgraph-specification", "version": 9}' }]);
  await expect(page.getByRole("status").filter({ hasText: "bad.goalgraph.json" })).toContainText("version: 9");
  await drop(page, [{ name: "bad.dot", text: "digraph {" }]);
  await expect(page.getByRole("status").filter({ hasText: "bad.dot" })).toContainText("line");
  expect(await exported(page)).toBe(before);
});

test("a 50 MB specification is refused with the limit", async ({ page }) => {
  await openTower(page);
  const text = '{"format": "goalgraph-specification", "name": "' + "x".repeat(50_000_000) + '"}';
  await drop(page, [{ name: "large.goalgraph.json", text }]);
  await expect(page.getByRole("status").filter({ hasText: "large.goalgraph.json" })).toContainText("25 MB");
  await expect(page.locator("[data-state]")).toHaveCount(5);
});

test("search, selection and zoom go together", async ({ page }) => {
  await openTower(page);
  await page.keyboard.press("Control+f");
  await page.keyboard.type("q3");
  await expect(page.getByRole("search")).toContainText("1 of 1");
  await page.keyboard.press("Enter");
  await expect(state(page, "q3")).toHaveAttribute("aria-pressed", "true");
  await page.keyboard.press("Escape");
  await page.keyboard.press("[");
  await expect(inspector(page)).toContainText("states selected");
  await page.keyboard.press("Shift+2");
  await page.keyboard.press("Control+a");
  await expect(inspector(page)).toContainText("5 states selected");
});

test("the menu at the pointer has the commands for what is there", async ({ page }) => {
  await openTower(page);
  await state(page, "q1").click({ button: "right" });
  const menu = page.getByRole("menu");
  await expect(menu.getByRole("menuitem", { name: /^Prune and heal/ })).toBeVisible();
  await expect(menu.getByRole("menuitem").first()).toBeFocused();
  await page.keyboard.press("Escape");
  await expect(menu).toHaveCount(0);
});

test("a walk takes steps, goes back, and follows what is switched off", async ({ page }) => {
  await openTower(page);
  await page.keyboard.press("e");
  const walk = page.getByRole("region", { name: "Walk" });
  await expect(walk).toContainText("in q0");
  await walk.getByRole("group", { name: "Possible now" }).getByRole("button").first().click();
  await expect(walk).not.toContainText("in q0");
  await expect(walk.getByRole("list", { name: "Steps so far" }).getByRole("listitem")).toHaveCount(1);
  await walk.getByRole("list", { name: "Steps so far" }).getByRole("button").first().click();
  await expect(walk).toContainText("in q0");
  const prospects = page.locator(".prospects");
  await expect(prospects).toContainText(/Success\s*1/);
  await page.getByRole("switch").first().click();
  await expect(prospects).not.toContainText(/Success\s*1/);
});

test("the text beside the picture follows every edit", async ({ page }) => {
  await openTower(page);
  await page.keyboard.press("x");
  const text = page.getByLabel("Text of the specification");
  await expect(text).toContainText("digraph");
  await page.getByRole("region", { name: "Text" }).getByRole("button", { name: "JSON", exact: true }).click();
  await expect(text).toContainText('"name": "Tower"');
  await page.getByLabel("Task name").fill("Another tower");
  await page.getByLabel("Task name").press("Enter");
  await expect(text).toContainText('"name": "Another tower"');
});

test("what a filter hides is said, and the specification stays", async ({ page }) => {
  await openTower(page);
  const before = await exported(page);
  await page.getByLabel("Hide transitions less probable than, in percent").fill("40");
  await expect(page.locator(".residue-note")).toContainText("hidden");
  await expect(page.locator(".residue").first()).toContainText("hidden");
  expect(await exported(page)).toBe(before);
});
