import { expect, type Locator, type Page, test } from "@playwright/test";
import { drop, exported, openApp } from "./page";
import { type Recording, restingRecording } from "./recordings";

/** The Sub-goals tab, with what the worker is asked and answers counted from the start. */
async function openSubGoals(page: Page, open: (page: Page) => Promise<void>): Promise<void> {
  await page.addInitScript(countSearches);
  await openApp(page);
  await open(page);
  await expect(page.locator('[data-state="q0"]')).toBeVisible({ timeout: 60_000 });
  await page.getByRole("tab", { name: "Sub-goals" }).click();
  await expect(page.getByRole("slider")).toBeVisible();
}

const openTower = (page: Page) => page.getByRole("button", { name: /^Tower/ }).click();

type Searches = { asked: number; answered: number; most: number; workers: number; learned: number };

/**
 * Wraps the page's workers: how many there are, how often they have learned,
 * and how many searches of one subset are asked for, answered, and under way at once.
 */
function countSearches(): void {
  const searches: Searches = { asked: 0, answered: 0, most: 0, workers: 0, learned: 0 };
  const text = (data: unknown) =>
    typeof data === "string" ? data : data instanceof Uint8Array ? new TextDecoder("latin1").decode(data) : "";
  window.Worker = class extends Worker {
    constructor(url: string | URL, options?: WorkerOptions) {
      super(url, options);
      searches.workers++;
      this.addEventListener("message", ({ data }) => {
        if (text(data).includes("Previewed")) searches.answered++;
        if (text(data).includes("Inferred")) searches.learned++;
      });
    }
    override postMessage(message: unknown, ...rest: unknown[]): void {
      if (Array.isArray(message) && text(message[0]).includes("Preview")) {
        searches.asked++;
        searches.most = Math.max(searches.most, searches.asked - searches.answered);
      }
      (super.postMessage as (...all: unknown[]) => void)(message, ...rest);
    }
  };
  Object.assign(window, { searches });
}

const searches = (page: Page) => page.evaluate(() => (window as unknown as { searches: Searches }).searches);

const slider = (page: Page) => page.getByRole("slider", { name: "epsilon of red" });
const valueOf = async (slider: Locator) => Number(await slider.getAttribute("aria-valuenow"));
const found = (page: Page) => page.getByRole("region", { name: "Epsilon" }).locator("[data-epsilon]");
const words = (page: Page) => page.getByRole("region", { name: "Places" }).locator(".words");

/** Takes hold of the handle and moves it to heights of its plot, 0 at the bottom; the button stays down. */
async function dragTo(page: Page, ...heights: number[]): Promise<void> {
  const handle = (await slider(page).boundingBox())!;
  const plot = (await slider(page).locator("..").boundingBox())!;
  const x = plot.x + plot.width / 2;
  await page.mouse.move(x, handle.y + handle.height / 2);
  await page.mouse.down();
  for (const height of heights) await page.mouse.move(x, plot.y + (1 - height) * plot.height, { steps: 12 });
}

test("a place vanishes while epsilon is dragged, and from the words once it is let go of", async ({ page }) => {
  await openSubGoals(page, openTower);
  await expect(found(page)).toHaveText("1 sub-goal");
  const learned = await valueOf(slider(page));

  await dragTo(page, 0);
  await expect(found(page)).toHaveText("0 sub-goals");
  expect(await valueOf(slider(page))).toBeLessThan(learned);
  await expect(words(page)).toContainText("red 1");
  await expect(page.getByRole("region", { name: "Feature subsets" })).toContainText("0 sub-goals");

  await page.mouse.up();
  await expect(words(page)).not.toContainText("red 1");
  await expect(words(page)).toContainText("yellow 1");
  await expect(page.getByLabel("epsilon", { exact: true })).toHaveValue(String(await valueOf(slider(page))));
  expect((await searches(page)).most).toBe(1);
});

test("two places become one while epsilon is dragged", async ({ page }) => {
  await openSubGoals(page, (page) => page.getByRole("button", { name: /^Four places/ }).click());
  const places = async () => Number((await found(page).textContent())!.match(/^\d+/)![0]);
  const learned = await places();
  expect(learned).toBeGreaterThan(2);
  const handle = page.getByRole("slider");
  await handle.focus();
  for (let step = 0; step < 10 && (await places()) >= learned; step++) {
    await page.keyboard.press("PageUp");
    await expect(found(page)).toHaveAttribute("data-epsilon", (await handle.getAttribute("aria-valuenow"))!);
  }
  expect(await places()).toBeLessThan(learned);
  await expect(page.locator(".plane").first()).toContainText(" + ");
  await page.keyboard.press("Escape");
  await expect.poll(places).toBe(learned);
});

test("a drag that is broken off leaves no trace", async ({ page }) => {
  await openSubGoals(page, openTower);
  await page.getByRole("tab", { name: "Automaton" }).click();
  const before = await exported(page);
  await page.getByRole("tab", { name: "Sub-goals" }).click();
  const learned = await valueOf(slider(page));

  await dragTo(page, 0);
  await expect(found(page)).toHaveText("0 sub-goals");
  await page.keyboard.press("Escape");
  await expect(found(page)).toHaveText("1 sub-goal");
  expect(await valueOf(slider(page))).toBe(learned);
  await page.mouse.move(5, 5);
  await page.mouse.up();
  expect(await valueOf(slider(page))).toBe(learned);

  await expect(page.getByRole("button", { name: "Automatic" })).toBeDisabled();
  await page.getByRole("tab", { name: "Automaton" }).click();
  expect(await exported(page)).toBe(before);
  await page.getByRole("tab", { name: "History" }).click();
  await expect(page.getByText(/Learn from/)).toHaveCount(0);
});

test("keys move epsilon, Enter keeps it, Escape puts it back, and the engine takes it again", async ({ page }) => {
  await openSubGoals(page, openTower);
  const learned = await valueOf(slider(page));
  await slider(page).focus();
  const values = [learned];
  for (const key of ["ArrowUp", "Shift+ArrowUp", "PageUp", "End"]) {
    await page.keyboard.press(key);
    values.push(await valueOf(slider(page)));
  }
  expect(values).toEqual([...values].sort((a, b) => a - b));
  expect(new Set(values).size).toBe(values.length);
  await expect(slider(page)).toHaveAttribute("aria-valuetext", /100% of .* points are core/);
  await page.keyboard.press("Escape");
  expect(await valueOf(slider(page))).toBe(learned);

  await page.keyboard.press("Home");
  await expect(found(page)).toHaveText("0 sub-goals");
  await page.keyboard.press("Enter");
  await expect(words(page)).not.toContainText("red 1");
  await expect(slider(page)).toBeFocused();

  await page.getByRole("button", { name: "Automatic" }).click();
  await expect(words(page)).toContainText("red 1");
  expect(await valueOf(slider(page))).toBe(learned);
});

/** Presses keys on the handle, all before the page hears anything from the worker. */
const pressAtOnce = (page: Page, ...keys: string[]) =>
  slider(page).evaluate((handle, keys) => {
    for (const key of keys) handle.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
  }, keys);

/** The epsilon that "red" was searched with. */
async function learnedEpsilon(page: Page): Promise<number> {
  await page.getByRole("tab", { name: "Automaton" }).click();
  const { subsets } = JSON.parse(await exported(page)) as { subsets: { name: string; epsilon: number }[] };
  return subsets.find(({ name }) => name === "red")!.epsilon;
}

/** Notes what the page says from now on. */
async function noteWords(page: Page): Promise<() => Promise<string[]>> {
  await page.evaluate(() => {
    const said: string[] = [];
    const status = document.querySelector('[role="status"]')!;
    new MutationObserver(() => said.push(status.textContent ?? "")).observe(status, { subtree: true, childList: true, characterData: true });
    Object.assign(window, { said });
  });
  return () => page.evaluate(() => (window as unknown as { said: string[] }).said);
}

test("an epsilon that is tried while the one before is learned with stays under the handle", async ({ page }) => {
  await openSubGoals(page, openTower);
  const { learned } = await searches(page);
  await slider(page).focus();
  await pressAtOnce(page, "ArrowUp", "Enter", "ArrowUp", "ArrowUp", "ArrowUp");
  const tried = await valueOf(slider(page));
  await expect.poll(async () => (await searches(page)).learned).toBe(learned + 1);
  await expect(found(page)).toHaveAttribute("data-epsilon", String(tried));
  expect(await valueOf(slider(page))).toBe(tried);

  await page.getByLabel("epsilon", { exact: true }).focus();
  await expect.poll(async () => (await searches(page)).learned).toBe(learned + 2);
  expect(await valueOf(slider(page))).toBe(tried);
  expect(await learnedEpsilon(page)).toBe(tried);
});

test("an epsilon that is let go of while the one before is learned with takes its place, quietly", async ({ page }) => {
  await openSubGoals(page, openTower);
  const { learned } = await searches(page);
  await slider(page).focus();
  const said = await noteWords(page);
  await pressAtOnce(page, "ArrowUp", "Enter", "ArrowUp", "ArrowUp", "Enter");
  const chosen = await valueOf(slider(page));
  await expect.poll(async () => (await searches(page)).learned).toBe(learned + 2);
  expect((await said()).join()).not.toContain("Canceled");
  expect((await searches(page)).workers).toBe(1);
  expect(await valueOf(slider(page))).toBe(chosen);
  expect(await learnedEpsilon(page)).toBe(chosen);
});

test("exact values are typed, and what makes no sense does not stay in the field", async ({ page }) => {
  await openSubGoals(page, openTower);
  const epsilon = page.getByLabel("epsilon", { exact: true });
  const learned = await epsilon.inputValue();
  await epsilon.fill("none");
  await epsilon.press("Enter");
  await expect(page.getByRole("status")).toContainText("epsilon is auto or a number above 0");
  await expect(epsilon).toHaveValue(learned);
  await epsilon.fill("0.0001");
  await epsilon.press("Enter");
  await expect(found(page)).toHaveText("0 sub-goals");
  await expect(slider(page)).toHaveAttribute("aria-valuenow", "0.0001");
  await epsilon.fill("auto");
  await epsilon.press("Enter");
  await expect(epsilon).toHaveValue(learned);
  await page.getByLabel("min. points").fill("3");
  await page.getByLabel("min. points").press("Enter");
  await expect(page.getByRole("region", { name: "Epsilon" })).toContainText("3rd nearest point");
});

test("edits are a step back when epsilon is chosen after them", async ({ page }) => {
  await openSubGoals(page, openTower);
  const name = page.locator('[data-sub-goal="g0"]').getByLabel("Name");
  await name.fill("left block");
  await name.press("Enter");
  await expect(words(page)).toContainText("left block");

  await slider(page).focus();
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  await expect(page.getByRole("status")).toContainText("Your edits are one step back");
  await expect(words(page)).not.toContainText("left block");
  await page.keyboard.press("Control+z");
  await expect(words(page)).toContainText("left block");
});

test("a specification without its recordings has no curve, and says so", async ({ page }) => {
  await openSubGoals(page, openTower);
  await page.getByRole("tab", { name: "Automaton" }).click();
  const text = await exported(page);
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  await page.getByRole("button", { name: "Clear" }).click();
  await drop(page, [{ name: "tower.goalgraph.json", text }]);
  await page.getByRole("tab", { name: "Sub-goals" }).click();
  await expect(page.getByRole("region", { name: "Epsilon" })).toContainText("no recordings are loaded");
  await expect(page.getByRole("slider")).toHaveCount(0);
});

test("dragging over a hundred thousand points stays fluid", async ({ page }) => {
  test.setTimeout(180_000);
  const recordings: Recording[] = Array.from({ length: 10 }, (_, seed) => restingRecording(`${seed}.csv`, 4000, seed));
  await openSubGoals(page, (page) => drop(page, recordings));
  await expect(slider(page)).toHaveAttribute("aria-valuetext", /of 1\d\d\s\d{3} points are core/);

  const idle = await longestGap(page, () => page.waitForTimeout(2000));
  const dragged = await longestGap(page, () => dragTo(page, 0.95, 0.3, 0.9, 0.5));
  const last = String(await valueOf(slider(page)));
  await expect(found(page)).toHaveAttribute("data-epsilon", last, { timeout: 60_000 });
  const { asked, most } = await searches(page);
  console.log(`longest gap between frames: idle ${idle.toFixed(0)} ms, dragging ${dragged.toFixed(0)} ms; ${asked} searches`);
  expect(asked).toBeGreaterThan(1);
  expect(most).toBe(1);

  await page.mouse.up();
  await expect(page.getByLabel("epsilon", { exact: true })).toHaveValue(last);
  await expect(found(page)).toHaveAttribute("data-epsilon", last);
  await expect(page.getByRole("button", { name: "Automatic" })).toBeEnabled();
});

/** The longest time between two frames of the page while something is done, in milliseconds. */
async function longestGap(page: Page, what: () => Promise<void>): Promise<number> {
  await page.evaluate(() => {
    const gaps = { longest: 0, last: performance.now(), on: true };
    const frame = (now: number) => {
      gaps.longest = Math.max(gaps.longest, now - gaps.last);
      gaps.last = now;
      if (gaps.on) requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    Object.assign(window, { gaps });
  });
  await what();
  return page.evaluate(() => {
    const { gaps } = window as unknown as { gaps: { longest: number; on: boolean } };
    gaps.on = false;
    return gaps.longest;
  });
}
