import { expect, test } from "@playwright/test";

test("the app opens with its four tabs", async ({ page }) => {
  await page.goto("/");

  await expect(page).toHaveTitle(/Goalgraph/);
  for (const name of ["Demonstrations", "Sub-goals", "Automaton", "Run"]) {
    await expect(page.getByRole("tab", { name, exact: true })).toBeVisible();
  }
});
