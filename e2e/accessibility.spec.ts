import { expect, test } from "@playwright/test";
import { findings, openApp } from "./page";

for (const colorScheme of ["light", "dark"] as const) {
  test(`axe finds nothing serious on any tab, ${colorScheme}`, async ({ page }) => {
    await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
    await openApp(page);
    expect.soft(await findings(page), "start").toEqual([]);
    await page.getByRole("button", { name: /^Two stacks/ }).click();
    await expect(page.locator('[data-state="q0"]')).toBeVisible();
    for (const tab of ["Demonstrations", "Sub-goals", "Run", "Automaton"]) {
      await page.getByRole("tab", { name: tab, exact: true }).click();
      expect.soft(await findings(page), tab).toEqual([]);
    }
    for (const list of ["Merges", "Problems", "History", "Variants"]) {
      await page.getByRole("tab", { name: list }).click();
      expect.soft(await findings(page), list).toEqual([]);
    }
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
}
