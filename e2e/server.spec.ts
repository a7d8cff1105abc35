import { type Browser, type Locator, type Page, expect, test } from "@playwright/test";
import { drop, findings, kept, openApp } from "./page";
import { threeRecordings } from "./recordings";

/** The revision that the work is, in the bar. */
const standing = (page: Page): Locator => page.getByRole("button", { name: /^Revision: / });
const dialog = (page: Page, name: string): Locator => page.getByRole("dialog", { name });
const status = (page: Page): Locator => page.locator(".notice");

/** A name that no other test has. */
let last = 0;
const fresh = (name: string): string => `${name} ${Date.now().toString(36)}${last++}`;

/** Learns a task from three recordings and calls it `name`. */
async function learn(page: Page, name: string): Promise<void> {
  await openApp(page);
  await drop(page, threeRecordings());
  await expect(page.locator("[data-state]")).toHaveCount(4);
  await rename(page, name);
}

async function rename(page: Page, name: string): Promise<void> {
  await page.getByLabel("Task name").fill(name);
  await page.keyboard.press("Enter");
  await expect(page.getByLabel("Task name")).toHaveValue(name);
  // Letters are commands again.
  await page.getByLabel("Task name").blur();
}

/** Saves and waits until the server has it. */
async function save(page: Page, revision: number): Promise<void> {
  await page.keyboard.press("Control+s");
  await expect(status(page)).toHaveText(`Saved as revision ${revision}.`);
}

/** Opens a specification of the server by its name. */
async function openFromServer(page: Page, name: string): Promise<void> {
  await page.keyboard.press("Control+o");
  await page.getByLabel("Search specifications").fill(name);
  await page.getByRole("list", { name: "Specifications" }).getByRole("button").click();
  await expect(page.getByLabel("Task name")).toHaveValue(name);
}

/** A browser that knows nothing of the others. */
async function another(browser: Browser): Promise<Page> {
  const page = await (await browser.newContext()).newPage();
  await openApp(page);
  return page;
}

async function prune(page: Page, transition: string): Promise<void> {
  await page.getByRole("tab", { name: "Automaton" }).click();
  await page.locator(`[data-transition="${transition}"] .name`).click();
  await page.keyboard.press("Delete");
  await page.getByRole("region", { name: "Preview" }).getByRole("button", { name: "Apply" }).click();
  await expect(page.locator(`[data-transition="${transition}"]`)).toHaveCount(0);
}

/** Two people have the same specification open, and the second has saved a revision 2 called `theirs`. */
async function conflict(page: Page, browser: Browser): Promise<{ mine: string; theirs: string }> {
  const name = fresh("Both");
  const [mine, theirs] = [`${name} mine`, `${name} theirs`];
  await learn(page, name);
  await save(page, 1);
  const other = await another(browser);
  await openFromServer(other, name);
  await rename(other, theirs);
  await save(other, 2);
  await other.context().close();
  await rename(page, mine);
  await page.keyboard.press("Control+s");
  await expect(dialog(page, "Somebody else saved meanwhile")).toContainText("saved revision 2");
  return { mine, theirs };
}

/** Closes the open dialog. */
async function close(page: Page): Promise<void> {
  await page.keyboard.press("Escape");
  await expect(page.getByRole("dialog")).toHaveCount(0);
}

async function approve(page: Page, revision: number): Promise<void> {
  const asked = dialog(page, "Approve");
  await asked.getByLabel("Your name").fill("Ada Approver");
  await asked.getByLabel("Comment").fill("looked at it");
  await asked.getByRole("button", { name: `Approve r${revision}` }).click();
  await expect(status(page)).toHaveText(`Revision ${revision} is approved by Ada Approver.`);
}

test("work that was saved is there after a reload and in another browser, with its recordings", async ({ page, browser }) => {
  const name = fresh("Kept");
  await learn(page, name);
  await expect(page.locator(".standing")).toHaveText("Not saved");
  await save(page, 1);
  await expect(standing(page)).toHaveText("r1");
  await rename(page, `${name} again`);
  await expect(standing(page)).toHaveText("r1, changed");
  await page.keyboard.press("Control+z");
  await expect(standing(page), "what was undone is no change").toHaveText("r1");
  await kept(page);
  await page.reload();
  await expect(page.getByLabel("Task name")).toHaveValue(name);
  await expect(standing(page)).toHaveText("r1");

  const other = await another(browser);
  await openFromServer(other, name);
  await expect(other.locator("[data-state]")).toHaveCount(4);
  await expect(standing(other)).toHaveText("r1");
  await other.getByRole("tab", { name: "Demonstrations" }).click();
  await expect(other.locator('[data-verdict="accepted"]')).toHaveCount(3);
  await expect(standing(other), "recordings that came with it change nothing").toHaveText("r1");
  await other.context().close();
});

test("a save says who did what, and every revision can be opened as a step that can be undone", async ({ page }) => {
  const name = fresh("Revisions");
  await learn(page, name);
  await save(page, 1);
  await prune(page, "q0 g1 q3");
  await page.keyboard.press("Control+Shift+s");
  await dialog(page, "Save with a message").getByLabel("Message", { exact: true }).fill("red always first");
  await dialog(page, "Save with a message").getByLabel("Your name").fill("Ada");
  await page.keyboard.press("Enter");
  await expect(status(page)).toHaveText("Saved as revision 2.");

  await page.keyboard.press("b");
  const revisions = dialog(page, "Revisions");
  await expect(revisions.locator('[data-revision="2"]')).toContainText("red always first");
  await expect(revisions.locator('[data-revision="2"]')).toContainText("Ada");
  await revisions.getByLabel("Compare revision 1").check();
  await revisions.getByLabel("Compare revision 2").check();
  await revisions.getByRole("button", { name: "Compare the two ticked" }).click();
  const difference = dialog(page, "What differs");
  await expect(difference.locator('[data-part="q0 g1"]')).toHaveAttribute("data-difference", "removed");
  await expect(difference.locator('[data-part="q0 g0"]')).toContainText("0.67 → 1");
  await expect(difference.getByText("No longer accepted: 1 word")).toBeVisible();
  await difference.getByRole("list", { name: "Changes" }).getByRole("button").first().click();
  await expect(difference.locator(".pointed")).toHaveCount(1);
  await close(page);

  await page.keyboard.press("b");
  await revisions.getByRole("button", { name: "Open revision 1" }).click();
  await expect(page.locator("[data-state]")).toHaveCount(4);
  await expect(standing(page)).toHaveText("r1 again");
  await page.keyboard.press("Control+z");
  await expect(page.locator("[data-state]")).toHaveCount(3);
  await expect(standing(page)).toHaveText("r2");
});

test("when somebody else saved meanwhile, theirs is seen on one canvas and taken, and mine is one step back", async ({ page, browser }) => {
  const { mine, theirs } = await conflict(page, browser);
  await dialog(page, "Somebody else saved meanwhile").getByRole("button", { name: "See what differs" }).click();
  const difference = dialog(page, "What differs");
  await expect(difference).toContainText("From your work to r2");
  await expect(difference.getByRole("list", { name: "Changes" })).toContainText(`${mine} → ${theirs}`);
  await difference.getByRole("button", { name: "Take theirs" }).click();
  await expect(page.getByLabel("Task name")).toHaveValue(theirs);
  await expect(standing(page)).toHaveText("r2");
  await page.keyboard.press("Control+z");
  await expect(page.getByLabel("Task name")).toHaveValue(mine);
  await expect(standing(page)).toHaveText("r2, changed");
  await save(page, 3);
});

test("when somebody else saved meanwhile, mine is kept as a copy and theirs stays", async ({ page, browser }) => {
  const { mine, theirs } = await conflict(page, browser);
  await dialog(page, "Somebody else saved meanwhile").getByRole("button", { name: "Keep mine as a copy" }).click();
  await expect(page.getByLabel("Task name")).toHaveValue(`${mine} (copy)`);
  await expect(standing(page)).toHaveText("r1");
  await page.keyboard.press("Control+o");
  const list = page.getByRole("list", { name: "Specifications" });
  await expect(list.getByRole("button", { name: `${mine} (copy)` })).toBeVisible();
  await expect(list.getByRole("button", { name: theirs })).toBeVisible();
});

test("a revision is approved once it was seen what differs from the approved one", async ({ page }) => {
  const name = fresh("Approved");
  await learn(page, name);
  await save(page, 1);
  await page.keyboard.press("q");
  await expect(dialog(page, "Approve")).toContainText("nothing was approved before");
  await approve(page, 1);
  await expect(standing(page)).toContainText("r1, approved");

  await prune(page, "q0 g1 q3");
  await page.keyboard.press("q");
  await expect(dialog(page, "Approve")).toContainText("Save your edits first");
  await expect(dialog(page, "Approve").getByRole("button", { name: "Approve r1" })).toBeDisabled();
  await close(page);
  await save(page, 2);
  await page.keyboard.press("q");
  const asked = dialog(page, "Approve");
  await expect(asked).toContainText("From r1 to r2");
  await expect(asked.locator('[data-part="q3"]')).toHaveAttribute("data-difference", "removed");
  await expect(asked.locator('[data-part="q0 g0"]')).toContainText("0.67 → 1");
  await expect(asked.getByText("No longer accepted: 1 word")).toBeVisible();
  await approve(page, 2);

  await page.keyboard.press("h");
  const steps = page.getByRole("list", { name: "Steps" }).getByRole("listitem");
  await expect(steps.filter({ hasText: "r2" })).toContainText("approved");
  await expect(steps.filter({ hasText: "r1" })).not.toContainText("approved");
  await page.keyboard.press("b");
  const journal = dialog(page, "Revisions").getByRole("list", { name: "Approvals" }).getByRole("listitem");
  await expect(journal).toHaveCount(2);
  await expect(journal.first()).toContainText("r2 approved by Ada Approver: Approved for production");
  await dialog(page, "Revisions").getByRole("button", { name: "Revoke the approval" }).click();
  await dialog(page, "Revoke the approval").getByRole("button", { name: "Revoke r2" }).click();
  await expect(standing(page)).toHaveText("r2");
});

test("a specification with an error cannot be approved, and the reason is said", async ({ page, request }) => {
  const name = fresh("Faulty");
  await learn(page, name);
  await page.locator('[data-state="q2"]').click();
  await page.keyboard.press("a");
  await page.getByRole("region", { name: "Preview" }).getByRole("button", { name: "Apply" }).click();
  await save(page, 1);
  await page.keyboard.press("q");
  const asked = dialog(page, "Approve");
  await asked.getByLabel("Your name").fill("Ada");
  await expect(asked.getByRole("region", { name: "Findings of the check" })).toContainText("Error");
  await expect(asked.getByRole("button", { name: "Approve r1" })).toBeDisabled();
  await expect(asked.getByRole("button", { name: "Approve r1" })).toHaveAccessibleDescription(/A robot must not be given this/);

  const { items } = await (await request.get("/api/v1/specifications")).json();
  const { id, head } = items.find((it: { name: string }) => it.name === name);
  const signature = { who: "Ada", meaning: "anyway", comment: "", sha256: head.sha256, instead_of: null };
  const refused = await request.post(`/api/v1/specifications/${id}/revisions/1/approval`, { data: signature });
  expect(refused.status(), "the server refuses it as well").toBe(422);
});

test("when somebody else approved meanwhile, nothing is signed, and it is said who", async ({ page, request }) => {
  const name = fresh("Raced");
  await learn(page, name);
  await save(page, 1);
  await prune(page, "q0 g1 q3");
  await save(page, 2);
  await page.keyboard.press("q");
  const asked = dialog(page, "Approve");
  await expect(asked.locator("[data-part]").first()).toBeVisible();
  const { items } = await (await request.get("/api/v1/specifications")).json();
  const { id } = items.find((it: { name: string }) => it.name === name);
  const first = await (await request.get(`/api/v1/specifications/${id}/revisions/1`)).json();
  const signature = { who: "Bo", meaning: "for the night shift", comment: "", sha256: first.revision.sha256, instead_of: null };
  expect((await request.post(`/api/v1/specifications/${id}/revisions/1/approval`, { data: signature })).status()).toBe(201);
  await asked.getByLabel("Your name").fill("Ada Approver");
  await asked.getByRole("button", { name: "Approve r2" }).click();
  await expect(asked.getByRole("alert")).toContainText("Bo approved r1");
  await expect(asked, "what is shown next is what differs from theirs").toContainText("From r1 to r2");
  await approve(page, 2);
});

test("a link opens a revision, as a step where there is unsaved work", async ({ page, browser, request }) => {
  const name = fresh("Linked");
  await learn(page, name);
  await save(page, 1);
  await rename(page, `${name} two`);
  await save(page, 2);
  const { items } = await (await request.get("/api/v1/specifications")).json();
  const { id } = items.find((it: { name: string }) => it.name === `${name} two`);

  const other = await (await browser.newContext()).newPage();
  await other.goto(`/#specification=${id}&revision=1`);
  await expect(other.getByLabel("Task name")).toHaveValue(name);
  await expect(standing(other)).toHaveText("r1; r2 is newer");
  expect(new URL(other.url()).hash, "loading the page again brings back the work").toBe("");

  await rename(other, `${name} mine`);
  await other.evaluate((id) => { location.hash = `specification=${id}&revision=2`; }, id);
  await expect(other.getByLabel("Task name")).toHaveValue(`${name} two`);
  await other.keyboard.press("Control+z");
  await expect(other.getByLabel("Task name"), "nothing is lost").toHaveValue(`${name} mine`);

  await other.evaluate(() => { location.hash = "specification=&revision=seven"; });
  await expect(status(other)).toContainText("The link is not understood");
  await other.context().close();
});

test("a save without a connection waits, over a reload too, and arrives", async ({ page, request, context }) => {
  const name = fresh("Offline");
  await learn(page, name);
  await save(page, 1);
  await rename(page, `${name} later`);
  await context.setOffline(true);
  await page.keyboard.press("Control+s");
  await expect(page.locator(".banner")).toContainText("The server does not answer");
  await expect(page.locator(".standing")).toHaveText("Waits to be saved");
  await context.setOffline(false);
  await expect(status(page)).toHaveText("Saved as revision 2.");
  await expect(page.locator(".banner")).toHaveCount(0);

  await rename(page, `${name} much later`);
  await page.route("**/api/v1/**", (route) => route.abort("internetdisconnected"));
  await page.keyboard.press("Control+s");
  await expect(page.locator(".banner")).toBeVisible();
  await expect.poll(() => work(page), "what waits is kept").toContain('"queued":{');
  await kept(page);
  await page.reload();
  await expect(page.locator(".banner")).toBeVisible();
  await page.unroute("**/api/v1/**");
  await expect(standing(page)).toHaveText("r3");
  const { items } = await (await request.get("/api/v1/specifications")).json();
  expect(items.map((it: { name: string }) => it.name)).toContain(`${name} much later`);
});

/** The work as the browser keeps it. */
function work(page: Page): Promise<string> {
  return page.evaluate(
    () =>
      new Promise<string>((resolve, reject) => {
        const opening = indexedDB.open("goalgraph");
        opening.onerror = () => reject(opening.error);
        opening.onsuccess = () => {
          const reading = opening.result.transaction("work").objectStore("work").get("current");
          reading.onerror = () => reject(reading.error);
          reading.onsuccess = () => {
            opening.result.close();
            resolve(String(reading.result));
          };
        };
      }),
  );
}

for (const colorScheme of ["light", "dark"] as const) {
  test(`axe finds nothing serious in the dialogs of the server, ${colorScheme}`, async ({ page }) => {
    await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
    await learn(page, fresh("Axe"));
    await save(page, 1);
    await page.keyboard.press("q");
    await expect(dialog(page, "Approve").locator("[data-part]").first()).toBeVisible();
    expect.soft(await findings(page), "the first approval").toEqual([]);
    await approve(page, 1);
    await prune(page, "q0 g1 q3");
    expect.soft(await findings(page), "the bar").toEqual([]);
    await page.keyboard.press("Control+Shift+s");
    expect.soft(await findings(page), "a message").toEqual([]);
    await page.keyboard.press("Enter");
    await expect(status(page)).toHaveText("Saved as revision 2.");
    await page.keyboard.press("q");
    await expect(dialog(page, "Approve").locator("[data-part]").first()).toBeVisible();
    expect.soft(await findings(page), "an approval with differences").toEqual([]);
    await close(page);
    await page.keyboard.press("b");
    await expect(dialog(page, "Revisions").locator("[data-revision]")).toHaveCount(2);
    expect.soft(await findings(page), "revisions").toEqual([]);
    await close(page);
    await page.keyboard.press("Control+o");
    await expect(page.getByRole("list", { name: "Specifications" })).toBeVisible();
    expect.soft(await findings(page), "specifications").toEqual([]);
  });
}
