import { expect, test } from "@playwright/test";
import { drop, openApp } from "./page";
import { recording } from "./recordings";
import { Robot } from "./robots";

// What the project is for, from the first file to the end of the run, with nothing but the page and a robot.

test("from dropped recordings to a robot that plans anew and finishes", async ({ page }) => {
  page.on("pageerror", (error) => expect.soft(error.message, "an error in the page").toBe(""));
  await openApp(page);
  await drop(page, [
    recording("a.csv", ["red", "yellow"], 1),
    recording("b.csv", ["red", "yellow"], 2),
    recording("c.csv", ["yellow"], 3),
    recording("d.csv", ["yellow", "red"], 4),
  ]);
  await expect(page.locator("[data-state]")).toHaveCount(4);

  // The expert: red after yellow alone was a mistake.
  const mistake = page.locator('[data-transition="q3 g0 q2"]');
  await mistake.locator(".name").click();
  await page.keyboard.press("Delete");
  await page.getByRole("region", { name: "Preview" }).getByRole("button", { name: "Apply" }).click();
  await expect(mistake).toHaveCount(0);

  const name = `Whole way ${Date.now().toString(36)}`;
  await page.getByLabel("Task name").fill(name);
  await page.keyboard.press("Enter");
  await page.getByLabel("Task name").blur();
  await page.keyboard.press("Control+s");
  await expect(page.locator(".notice")).toHaveText("Saved as revision 1.");
  await page.keyboard.press("q");
  const asked = page.getByRole("dialog", { name: "Approve" });
  await asked.getByLabel("Your name").fill("Ada");
  await asked.getByRole("button", { name: "Approve r1" }).click();
  await expect(page.getByRole("button", { name: /^Revision: / })).toContainText("r1, approved");

  const { items } = await (await page.request.get("/api/v1/specifications?limit=1")).json();
  const approved = { id: items[0].id, revision: 1, sha256: items[0].head.sha256 };
  expect(items[0].name).toBe(name);
  const robot = Robot.start(`arm-${Date.now()}`, approved, ["--speed", "0.005", "--becomes-unavailable", "red@2.5"]);
  try {
    await page.getByRole("tab", { name: "Run", exact: true }).click();
    await page.getByRole("button", { name: /^Monitoring/ }).click();
    const card = page.locator(`[data-executor="${robot.name}"]`);
    await expect(card).toContainText("accepted");
    await card.getByRole("button", { name: "Start" }).click();
    await expect(page.locator('[data-state="q0"][data-live-state="running"]')).toBeVisible();
    await expect(page.locator("[data-replanned]")).toContainText("red 1 unavailable; now yellow 1");
    await expect(page.locator('[data-state="q3"][data-live-state="finished"]')).toBeVisible();
    await expect(page.locator('[data-transition="q0 g1 q3"]')).toHaveClass(/passed/);
  } finally {
    await robot.end();
  }
});
