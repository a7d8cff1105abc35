import { expect, test } from "@playwright/test";
import { drop, openApp } from "./page";
import { threeRecordings } from "./recordings";

test.beforeEach(async ({ page }) => {
  await openApp(page);
  await drop(page, threeRecordings());
  await expect(page.locator("[data-state]")).toHaveCount(4);
});

test("sub-goals are listed per subset, with the parameters they were found with", async ({ page }) => {
  await page.getByRole("tab", { name: "Sub-goals" }).click();

  const subsets = page.getByRole("region", { name: "Feature subsets" }).getByRole("button");
  await expect(subsets).toHaveCount(2);
  await expect(subsets.first()).toContainText("epsilon");
  const found = page.getByRole("complementary", { name: "Sub-goals" });
  await expect(found.locator('[data-sub-goal="g0"]')).toContainText("red 1");
  await expect(found.locator('[data-sub-goal="g0"]')).toContainText(/Demonstrations\s*3/);
  await subsets.nth(1).click();
  await expect(found.locator('[data-sub-goal="g1"]')).toContainText("yellow 1");
});

test("changed settings are said to be newer than the automaton until it is inferred again", async ({ page }) => {
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  const settings = page.getByRole("complementary", { name: "Settings" });
  await settings.getByRole("button", { name: "Remove subset yellow" }).click();

  const outdated = page.getByText("The automaton is from before your last change.");
  await expect(outdated).toBeVisible();
  await settings.getByRole("button", { name: "Infer" }).click();
  await expect(outdated).toBeHidden();
  await page.getByRole("tab", { name: "Automaton" }).click();
  // Without the yellow block there is one sub-goal: before it and after it.
  await expect(page.locator("[data-state]")).toHaveCount(2);
});

test("a parameter that makes no sense is refused with what is expected", async ({ page }) => {
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  const epsilon = page.getByLabel("epsilon").first();
  await epsilon.fill("-1");
  await epsilon.press("Enter");

  await expect(page.getByRole("status")).toContainText("epsilon is auto or a number above 0");
  await expect(page.getByText("The automaton is from before your last change.")).toBeHidden();
});

test("the reading of the weights changes the probabilities without a new inference", async ({ page }) => {
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  await page.getByLabel("Probabilities").selectOption("published");
  await expect(page.getByText("The automaton is from before your last change.")).toBeHidden();
  await page.getByRole("tab", { name: "Automaton" }).click();
  const [saved] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Export JSON" }).click(),
  ]);
  const chunks: Buffer[] = [];
  for await (const chunk of await saved.createReadStream()) chunks.push(chunk as Buffer);
  expect(JSON.parse(Buffer.concat(chunks).toString("utf8")).semantics).toBe("published");
});
