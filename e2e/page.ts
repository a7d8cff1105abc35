import { expect, type Page } from "@playwright/test";
import type { Recording } from "./recordings";

/** Opens the app and waits until it listens. */
export async function openApp(page: Page): Promise<void> {
  await page.goto("/");
  await expect(page.getByRole("tab", { name: "Demonstrations" })).toBeVisible();
}

/** Drops files on the page, as a file manager does. */
export async function drop(page: Page, files: Recording[]): Promise<void> {
  const transfer = await page.evaluateHandle((files) => {
    const transfer = new DataTransfer();
    for (const { name, text } of files) transfer.items.add(new File([text], name));
    return transfer;
  }, files);
  await page.dispatchEvent("body", "dragenter", { dataTransfer: transfer });
  await page.dispatchEvent("body", "dragover", { dataTransfer: transfer });
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
}
