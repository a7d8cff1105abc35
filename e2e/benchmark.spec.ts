import { expect, test } from "@playwright/test";
import { openApp } from "./page";

// Measures and prints; what is slow fails nothing, for machines differ.
test("the benchmark page measures automata of 16, 256 and 4,096 states", async ({ page }) => {
  await openApp(page);
  await page.keyboard.press("Control+k");
  await page.keyboard.type("benchmark");
  await page.keyboard.press("Enter");
  const dialog = page.getByRole("dialog", { name: "Benchmark" });
  await dialog.getByRole("button", { name: "Measure" }).click();
  const rows = dialog.locator("tbody tr");
  await expect(rows).toHaveCount(3, { timeout: 50_000 });
  const heads = await dialog.locator("thead th").allInnerTexts();
  for (const row of await rows.all()) {
    const cells = await row.locator("th, td").allInnerTexts();
    console.log(cells.map((cell, index) => `${heads[index]} ${cell.replace(/\s+/g, " ")}`).join(", "));
  }
  expect(await rows.evaluateAll((rows) => rows.map((row) => row.getAttribute("data-states")))).toEqual([
    "16",
    "256",
    "4096",
  ]);
});
