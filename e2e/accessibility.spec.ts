import { expect, test, type Page } from "@playwright/test";
import { findings, openApp } from "./page";

async function openSample(page: Page) {
  await page.getByRole("button", { name: /^Two stacks/ }).click();
  await expect(page.locator('[data-state="q0"]')).toBeVisible();
}

for (const colorScheme of ["light", "dark"] as const) {
  test.describe(`axe, ${colorScheme}`, () => {
    test.use({ colorScheme, contextOptions: { reducedMotion: "reduce" } });

    test("finds nothing serious at the start and on any tab", async ({ page }) => {
      await openApp(page);
      expect.soft(await findings(page), "start").toEqual([]);
      await openSample(page);
      for (const tab of ["Demonstrations", "Sub-goals", "Run", "Automaton"]) {
        await page.getByRole("tab", { name: tab, exact: true }).click();
        expect.soft(await findings(page), tab).toEqual([]);
      }
    });

    test("finds nothing serious in any list beside the graph", async ({ page }) => {
      await openApp(page);
      await openSample(page);
      for (const list of ["Merges", "Problems", "History", "Variants"]) {
        await page.getByRole("tab", { name: list }).click();
        expect.soft(await findings(page), list).toEqual([]);
      }
    });

    test("finds nothing serious in what opens over the graph", async ({ page }) => {
      await openApp(page);
      await openSample(page);
      await page.locator('[data-state="q0"]').click();
      expect.soft(await findings(page), "a state").toEqual([]);
      await page.locator("[data-transition]").first().focus();
      await page.keyboard.press("Enter");
      await page.keyboard.press("Delete");
      await expect(page.getByRole("region", { name: "Preview" })).toBeVisible();
      expect.soft(await findings(page), "a preview").toEqual([]);
      await page.keyboard.press("Escape");
      await page.keyboard.press("t");
      expect.soft(await findings(page), "the table").toEqual([]);
      await page.keyboard.press("Control+k");
      expect.soft(await findings(page), "the palette").toEqual([]);
    });
  });
}
