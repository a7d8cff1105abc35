import { readFile } from "node:fs/promises";
import { expect, test } from "@playwright/test";
import { openApp } from "./page";

test("from the start screen to the exported automaton by keyboard alone", async ({ page }) => {
  await openApp(page);
  await expect(page.getByRole("button", { name: /^Tower/ })).toBeVisible();

  await page.keyboard.press("Control+k");
  const palette = page.getByRole("dialog", { name: "Commands" });
  await expect(palette.getByRole("combobox")).toBeFocused();
  await page.keyboard.type("tower");
  await expect(palette.getByRole("option")).toHaveCount(1);
  await page.keyboard.press("Enter");
  await expect(page.locator("[data-state]")).toHaveCount(5);

  // Tab goes through the transitions and states; Enter selects.
  const focusedState = () => page.evaluate(() => document.activeElement?.getAttribute("data-state"));
  for (let presses = 0; presses < 60 && (await focusedState()) === null; presses++) await page.keyboard.press("Tab");
  expect(await focusedState()).toBe("q0");
  await page.keyboard.press("Enter");
  await expect(page.getByRole("heading", { name: "State q0" })).toBeVisible();
  expect(await focusedState(), "the focus stays where it was").toBe("q0");
  await page.keyboard.press("Escape");
  await expect(page.getByRole("heading", { name: "State q0" })).toBeHidden();

  const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("j")]);
  expect(saved.suggestedFilename()).toBe("tower.goalgraph.json");
  expect(JSON.parse(await readFile(await saved.path(), "utf8")).automaton.states).toHaveLength(5);
});

test("numbers and arrow keys change tabs", async ({ page }) => {
  await openApp(page);
  const tab = (name: string) => page.getByRole("tab", { name });
  for (const [key, name] of [["3", "Automaton"], ["2", "Sub-goals"], ["4", "Run"], ["1", "Demonstrations"]]) {
    await page.keyboard.press(key);
    await expect(tab(name)).toHaveAttribute("aria-selected", "true");
  }
  await tab("Demonstrations").focus();
  await page.keyboard.press("ArrowRight");
  await expect(tab("Sub-goals")).toBeFocused();
  await expect(tab("Sub-goals")).toHaveAttribute("aria-selected", "true");
});

test("every command is on the help page, with its key", async ({ page }) => {
  await openApp(page);
  await page.keyboard.press("?");
  const help = page.getByRole("dialog", { name: "Help" });
  for (const [command, key] of [["Infer", "I"], ["Save", "Ctrl+S"], ["Export JSON", "J"], ["Commands", "Ctrl+K"], ["Fit", "Shift+1"]]) {
    await expect(help.getByRole("row").filter({ has: page.getByRole("rowheader", { name: command, exact: true }) })).toContainText(key);
  }
  await page.keyboard.press("Escape");
  await expect(help).toBeHidden();
});

test("a letter in a text field is a letter", async ({ page }) => {
  await openApp(page);
  await page.getByLabel("Task name").fill("");
  await page.getByLabel("Task name").pressSequentially("m1?");
  await expect(page.getByLabel("Task name")).toHaveValue("m1?");
  await expect(page.getByRole("dialog")).toHaveCount(0);
});
