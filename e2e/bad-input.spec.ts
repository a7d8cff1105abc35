import { expect, test } from "@playwright/test";
import { drop, dropOnceBusy, openApp } from "./page";
import { recording, repeated, threeRecordings } from "./recordings";

test.beforeEach(async ({ page }) => {
  await openApp(page);
});

test("a bad file among good ones is refused with its line, and the good ones stay", async ({ page }) => {
  await drop(page, [...threeRecordings(), { name: "ragged.csv", text: "red.x,red.y\n0.1,0.2\n0.3\n" }]);

  const bad = page.locator('[data-file="ragged.csv"]');
  await expect(bad).toHaveAttribute("data-verdict", "refused");
  await expect(bad).toContainText("line 3");
  await expect(page.locator('[data-verdict="accepted"]')).toHaveCount(3);
  await page.getByRole("tab", { name: "Automaton" }).click();
  await expect(page.locator("[data-state]")).toHaveCount(4);
});

for (const { what, text } of [
  { what: "without a byte", text: "" },
  { what: "with a header only", text: "red.x,red.y\n" },
  { what: "of binary bytes", text: "\u0000\u0001\u0002\uFFFD".repeat(200) },
  { what: "with two equal feature names", text: "x,x\n1,2\n" },
  { what: "with a number that is none", text: "x,y\n1,1e999\n" },
]) {
  test(`a file ${what} is refused with a reason`, async ({ page }) => {
    await drop(page, [{ name: "bad.csv", text }]);

    const bad = page.locator('[data-file="bad.csv"]');
    await expect(bad).toHaveAttribute("data-verdict", "refused");
    await expect(bad.getByText(/^Refused: .{10,}/)).toBeVisible();
  });
}

test("a bad file that comes during an inference does not end it", async ({ page }) => {
  const orders = [["red", "yellow"], ["yellow", "red"]];
  const slow = Array.from({ length: 20 }, (_, index) => repeated(recording(`${index}.csv`, orders[index % 2], index), 60));
  await dropOnceBusy(page, { name: "notes.txt", text: "a,b\n1\n" });
  await drop(page, slow);

  await expect(page.locator('[data-file="notes.txt"]')).toHaveAttribute("data-verdict", "refused");
  await expect(page.getByRole("status")).toContainText("4 states from 20 demonstrations");
  await page.getByRole("tab", { name: "Automaton" }).click();
  await expect(page.locator("[data-state]")).toHaveCount(4);
});

test("a file with other features is refused with the difference", async ({ page }) => {
  const other = recording("other.csv", ["red"], 7);
  await drop(page, threeRecordings());
  await expect(page.locator("[data-state]")).toHaveCount(4);
  await drop(page, [{ name: "other.csv", text: other.text.replace("yellow.z", "blue.z") }]);
  await page.getByRole("tab", { name: "Demonstrations" }).click();

  const refused = page.locator('[data-file="other.csv"]');
  await expect(refused).toHaveAttribute("data-verdict", "refused");
  await expect(refused).toContainText("its features are not those of a.csv: it does not have yellow.z and also has blue.z");
  await expect(page.locator('[data-verdict="accepted"]')).toHaveCount(3);
});

test("a file that was fixed takes the place of the bad one", async ({ page }) => {
  await drop(page, [{ name: "a.csv", text: "x,y\n1\n" }]);
  await expect(page.locator('[data-file="a.csv"]')).toHaveAttribute("data-verdict", "refused");
  await drop(page, threeRecordings());

  await expect(page.locator("[data-state]")).toHaveCount(4);
  await page.getByRole("tab", { name: "Demonstrations" }).click();
  await expect(page.locator("[data-file]")).toHaveCount(3);
  await expect(page.locator('[data-verdict="accepted"]')).toHaveCount(3);
});

test("a single frame gives an automaton without transitions, or a sentence why not", async ({ page }) => {
  await drop(page, [{ name: "one.csv", text: "x,y\n0.1,0.2\n" }]);

  await expect(page.locator('[data-file="one.csv"]')).toHaveAttribute("data-verdict", "accepted");
  await expect(page.getByRole("status")).toContainText(/0 sub-goals/);
  await page.getByRole("tab", { name: "Automaton" }).click();
  await expect(page.locator("[data-state]")).toHaveCount(1);
});

test("while a file is dragged over the page, the page says that it can be dropped", async ({ page }) => {
  const transfer = await page.evaluateHandle(() => {
    const transfer = new DataTransfer();
    transfer.items.add(new File(["x"], "a.csv"));
    return transfer;
  });
  await page.dispatchEvent("body", "dragenter", { dataTransfer: transfer });
  await expect(page.getByText("Drop to open")).toBeVisible();
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
  await expect(page.getByText("Drop to open")).toBeHidden();
});
