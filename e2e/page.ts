import { readFile } from "node:fs/promises";
import AxeBuilder from "@axe-core/playwright";
import { expect, type Page } from "@playwright/test";
import type { Recording } from "./recordings";

/** Opens the app and waits until it listens. */
export async function openApp(page: Page): Promise<void> {
  await page.goto("/");
  await expect(page.getByRole("tab", { name: "Demonstrations" })).toBeVisible();
}

/** Waits until the page has rehearsed what happens between a drop and a drawn automaton. */
export async function rehearsed(page: Page): Promise<void> {
  await page.waitForFunction(() => performance.getEntriesByName("rehearsed").length > 0);
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

/** The specification as the export button gives it. */
export async function exported(page: Page): Promise<string> {
  const [saved] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Export JSON" }).click(),
  ]);
  return readFile(await saved.path(), "utf8");
}

/** Forgets the work of earlier visits, from a page of the same server that is not the app. */
export async function forgetWork(page: Page): Promise<void> {
  await page.goto("/samples/index.json");
  await page.evaluate(
    () =>
      new Promise<void>((resolve, reject) => {
        const deleting = indexedDB.deleteDatabase("goalgraph");
        deleting.onsuccess = () => resolve();
        deleting.onerror = () => reject(deleting.error);
      }),
  );
}

/**
 * Has the page tell itself, by the event "busy", once the worker tells that it infers. What is to happen then is done
 * within the page: a click from outside can come after the worker has finished.
 */
async function watchWork(page: Page): Promise<void> {
  await page.evaluate(() => {
    const watching = new MutationObserver(() => {
      if (!/(Looking at|Clustering|Reading words)/.test(document.body.innerText)) return;
      watching.disconnect();
      document.dispatchEvent(new Event("busy"));
    });
    watching.observe(document.body, { subtree: true, childList: true, characterData: true });
  });
}

/**
 * Clicks Cancel as soon as the worker tells that it infers. The page is held up before, so that what the worker says
 * meanwhile waits for it.
 */
export async function cancelOnceBusy(page: Page): Promise<void> {
  await page.evaluate(() => {
    const cancel = () => {
      for (const until = performance.now() + 100; performance.now() < until; );
      [...document.querySelectorAll("button")].find((it) => it.textContent?.trim() === "Cancel")?.click();
    };
    document.addEventListener("busy", cancel, { once: true });
  });
  await watchWork(page);
}

/** Drops a file as soon as the worker tells that it infers. */
export async function dropOnceBusy(page: Page, file: Recording): Promise<void> {
  await page.evaluate(({ name, text }) => {
    const drop = () => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([text], name));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    };
    document.addEventListener("busy", drop, { once: true });
  }, file);
  await watchWork(page);
}

/** Counts the workers that the page starts, from before it opens. */
export async function countWorkers(page: Page): Promise<() => Promise<number>> {
  await page.addInitScript(() => {
    const counted = { workers: 0 };
    Object.assign(window, { counted });
    window.Worker = class extends Worker {
      constructor(url: string | URL, options?: WorkerOptions) {
        super(url, options);
        counted.workers++;
      }
    };
  });
  return () => page.evaluate(() => (window as unknown as { counted: { workers: number } }).counted.workers);
}

/** Waits until the browser has kept what was done last, a quarter of a second later. */
export async function kept(page: Page): Promise<void> {
  await page.waitForTimeout(1000);
}

/** Serious and critical findings on the page as it is, as sentences. */
export async function findings(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
  return serious.flatMap(({ id, help, nodes }) => nodes.map((node) => `${id}: ${help}: ${node.target.join(" ")}`));
}
