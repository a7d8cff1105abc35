import { expect, test } from "@playwright/test";
import { drop, forgetWork, openApp, rehearsed } from "./page";
import { threeRecordings } from "./recordings";

test("what the page rehearses leaves nothing behind", async ({ page }) => {
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  await forgetWork(page);
  await openApp(page);
  await rehearsed(page);

  await expect(page.getByRole("tab", { name: "Demonstrations" })).toHaveAttribute("aria-selected", "true");
  await expect(page.getByRole("heading", { name: "Or start with a sample" })).toBeVisible();
  expect(await page.locator("[data-state], [data-file], .rehearsal").count()).toBe(0);
  expect(await page.locator("#panel").count()).toBe(1);

  await drop(page, threeRecordings());

  await expect(page.locator("[data-state]")).toHaveCount(4);
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  await expect(page.locator("[data-file]")).toHaveCount(3);
  await expect(page.getByLabel("Task name")).toHaveValue("Untitled task");
  expect(errors).toEqual([]);
});
