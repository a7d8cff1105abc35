import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { type Locator, type Page, expect, test } from "@playwright/test";
import { drop, exported, findings, openApp } from "./page";
import { recording } from "./recordings";
import { type Approved, Robot, Server, approve, approveLast, approveNext, reportRun, serverPort } from "./robots";

// Things are a few millimeters from their places for the simulated robot, so it is slow: there is time to see it work.

// Red first or not at all: when red cannot be done, there is another way to the end.
const recordings = [
  recording("a.csv", ["red", "yellow"], 1),
  recording("b.csv", ["red", "yellow"], 2),
  recording("c.csv", ["yellow"], 3),
];

let robots: Robot[] = [];
let number = 0;

test.beforeEach(async ({ page }) => {
  page.on("pageerror", (error) => expect.soft(error.message, "an error in the page").toBe(""));
});

test.afterEach(async () => {
  await Promise.all(robots.map((robot) => robot.end()));
  robots = [];
});

/** A name that no other test has. */
function fresh(what: string): string {
  number += 1;
  return `${what}-${process.pid}-${Date.now()}-${number}`;
}

/** Drops the recordings, and approves what was learned from them. */
async function learnAndApprove(page: Page): Promise<Approved> {
  await openApp(page);
  await drop(page, recordings);
  await expect(page.locator('[data-state="q0"]')).toBeVisible();
  return approve(page.request, await exported(page));
}

/** Names the task and saves that. */
async function saveAs(page: Page, name: string, revision: number): Promise<void> {
  await page.getByLabel("Task name").fill(name);
  await page.keyboard.press("Enter");
  await page.keyboard.press("Control+s");
  await expect(page.locator(".notice")).toHaveText(`Saved as revision ${revision}.`);
}

function robot(approved: Approved, ...args: string[]): Robot {
  const started = Robot.start(fresh("robot"), approved, args);
  robots.push(started);
  return started;
}

async function monitor(page: Page): Promise<void> {
  await page.getByRole("tab", { name: "Run", exact: true }).click();
  await page.getByRole("button", { name: /^Monitoring/ }).click();
}

const card = (page: Page, { name }: { name: string }): Locator => page.locator(`[data-executor="${name}"]`);
const live = (page: Page): Locator => page.locator("[data-live-state]");
const canvas = (page: Page): Locator => page.getByRole("region", { name: "Run", exact: true });
const event = (page: Page, text: string): Locator => page.locator("[data-event]", { hasText: text }).first();

test("a robot follows what was approved, plans anew when a sub-goal drops out, and finishes", async ({ page }) => {
  const approved = await learnAndApprove(page);
  const started = robot(approved, "--speed", "0.005", "--becomes-unavailable", "red@2.5");
  await monitor(page);
  const executor = card(page, started);
  await expect(executor).toContainText("accepted");
  await expect(executor).toContainText(`r${approved.revision}`);
  await expect(executor).toContainText("on display");
  const pause = executor.getByRole("button", { name: "Pause" });
  await expect(pause, "there is nothing to pause").toBeDisabled();
  await expect(pause).toHaveAttribute("title", /is in no run/);

  await executor.getByRole("button", { name: "Start" }).click();
  await expect(page.locator('[data-state="q0"][data-live-state="running"]')).toBeVisible();
  await expect(page.locator('[data-transition^="q0 g0"]')).toHaveClass(/active/);
  await expect(executor.getByRole("button", { name: "Start" })).toBeDisabled();

  const announced = page.locator("[data-replanned]");
  await expect(announced).toContainText("Re-planned: red 1 unavailable; now yellow 1");
  await expect(page.locator('[aria-live="polite"]', { has: announced })).toBeVisible();
  await expect(page.locator('[data-transition^="q0 g0"]')).toHaveClass(/(?=.*\bout\b)(?=.*\babandoned\b)/);
  await expect(page.getByRole("list", { name: "Unavailable" })).toContainText("red 1");

  await expect(live(page)).toHaveAttribute("data-live-state", "finished");
  await expect(canvas(page)).toContainText("finished");
  await expect(page.locator('[data-transition^="q0 g1"]')).toHaveClass(/passed/);
  await expect(live(page)).toHaveAttribute("aria-label", /the run is here, finished/);
});

test("a finished run is replayed event by event, and its log is filtered", async ({ page }) => {
  const approved = await learnAndApprove(page);
  const started = robot(approved, "--speed", "5", "--runs", "1");
  await monitor(page);
  const run = page.locator("[data-run]", { hasText: started.name.slice(0, 12) }).first();
  await expect(run).toContainText("finished");
  await run.click();
  await expect(live(page)).toHaveAttribute("data-live-state", "finished");

  await event(page, "Started red 1").click();
  await expect(page.locator('[data-state="q0"][data-live-state="running"]')).toBeVisible();
  await expect(canvas(page)).toContainText("replay, event");
  await event(page, "Completed red 1").click();
  await expect(page.locator('[data-state="q0"]')).not.toHaveAttribute("data-live-state");
  await expect(page.locator('[data-transition^="q0 g0"]')).toHaveClass(/passed/);

  const slider = page.getByRole("slider", { name: "Event", exact: true });
  await slider.fill("0");
  await expect(page.locator('[data-state="q0"][data-live-state]')).toBeVisible();
  await page.getByRole("combobox", { name: "Events a second" }).selectOption("20");
  await canvas(page).locator(".headline").click();
  await page.keyboard.press("Space");
  await expect(live(page), "it plays to the end").toHaveAttribute("data-live-state", "finished");

  const events = page.getByRole("list", { name: "Events", exact: true }).getByRole("listitem");
  await page.getByRole("combobox", { name: "Kind of event" }).selectOption("Plans");
  await expect(events).toHaveCount(1);
  await expect(events).toContainText("Planned from q0: red 1, yellow 1");
  await page.getByRole("combobox", { name: "Kind of event" }).selectOption("All kinds");
  await page.getByRole("searchbox", { name: "Filter events by text" }).fill("completed yellow");
  await expect(events).toHaveCount(1);
  await events.getByRole("button").click();
  await page.getByRole("searchbox", { name: "Filter events by text" }).fill("no such thing");
  await expect(events).toHaveCount(0);
});

test("what happened while events were on their way is fetched as well", async ({ page }) => {
  const approved = await learnAndApprove(page);
  let asked = 0;
  await page.route("**/api/v1/runs/*/events?*", async (route) => {
    asked += 1;
    if (asked > 1) return route.continue();
    // The answer of a server that knew of no event when it was asked arrives when the run is over.
    await expect(live(page)).toHaveAttribute("data-live-state", "finished");
    return route.fulfill({ json: { items: [], next: null } });
  });
  await monitor(page);
  robot(approved, "--speed", "0.05", "--runs", "1");
  await expect(live(page)).toHaveAttribute("data-live-state", "finished");
  await expect(event(page, "Started red 1")).toBeVisible();
  await expect(event(page, "Completed yellow 1")).toBeVisible();
});

test("who comes late sees the run as it is, and opens the revision that it follows", async ({ page, browser }) => {
  const approved = await learnAndApprove(page);
  const started = robot(approved, "--speed", "0.005");
  await monitor(page);
  await card(page, started).getByRole("button", { name: "Start" }).click();
  await expect(live(page)).toHaveAttribute("data-live-state", "running");
  await card(page, started).getByRole("button", { name: "Pause" }).click();
  await expect(card(page, started).getByRole("button", { name: "Resume" })).toBeEnabled();

  const late = await (await browser.newContext()).newPage();
  await openApp(late);
  await monitor(late);
  await late.locator(`[data-executor="${started.name}"]`).getByRole("button", { name: /^Run / }).click();
  await expect(canvas(late)).toContainText("paused");
  await expect(canvas(late), "the names come from what the run follows").toContainText("red 1");
  await expect(late.locator("[data-state]"), "nothing is open").toHaveCount(0);
  await late.getByRole("button", { name: "Open the revision of the run" }).click();
  await expect(late.locator('[data-state="q0"]')).toBeVisible();
  await monitor(late);
  await expect(live(late)).toHaveAttribute("data-live-state", "paused");

  await card(page, started).getByRole("button", { name: "Stop" }).click();
  await expect(live(page)).toHaveAttribute("data-live-state", "stopped");
  await expect(live(late)).toHaveAttribute("data-live-state", "stopped");
  await late.context().close();
});

test("a run of another revision than the one on display is not drawn on it", async ({ page }) => {
  const approved = await learnAndApprove(page);
  const started = robot(approved);
  await monitor(page);
  await expect(card(page, started)).toContainText("on display");
  await page.getByRole("tab", { name: "Automaton", exact: true }).click();
  await page.getByLabel("Task name").fill(fresh("Renamed"));
  await page.keyboard.press("Enter");
  await monitor(page);
  await expect(card(page, started)).not.toContainText("on display");
  await card(page, started).getByRole("button", { name: "Start" }).click();
  await expect(page.getByRole("note")).toContainText(`${started.name} runs r1`);
  await expect(live(page)).toHaveCount(0);

  // Once that is approved, the robot is to follow it in its next run.
  await page.getByRole("tab", { name: "Automaton", exact: true }).click();
  const next = await approveNext(page.request, approved, await exported(page));
  await monitor(page);
  await expect(card(page, started)).toContainText(`r${next.revision}`);
  await expect(card(page, started)).toContainText("on display");
});

test("a robot that holds another revision than the one on display says so, and both ways are open", async ({ page }) => {
  await openApp(page);
  await drop(page, recordings);
  await expect(page.locator('[data-state="q0"]')).toBeVisible();
  await saveAs(page, fresh("Kept"), 1);
  const approved = await approveLast(page.request);
  const started = robot(approved);
  await monitor(page);
  await expect(card(page, started)).toContainText("on display");

  await saveAs(page, fresh("Kept"), 2);
  await expect(card(page, started)).toContainText("you view r2");
  await card(page, started).getByRole("button", { name: "Difference between r1 and r2" }).click();
  await expect(page.getByRole("dialog", { name: "What differs" })).toBeVisible();
  await page.keyboard.press("Escape");
  await card(page, started).getByRole("button", { name: "Open r1" }).click();
  await expect(card(page, started), "watching goes on").toContainText("on display");
});

test("a run that left the automaton is promoted to a demonstration, as one step", async ({ page, browser }) => {
  const approved = await learnAndApprove(page);
  const before = await exported(page);
  const other = await (await browser.newContext()).newPage();
  await other.goto("/samples/index.json");
  const [run, name] = [fresh("run"), fresh("strange")];
  await reportRun(other, name, approved, run, [
    { event: "planned", state: "q0", word: ["g0", "g1"], probability: 0.6667 },
    { event: "started", sub_goal: "g0" },
    { event: "completed", sub_goal: "g1" },
    { event: "completed", sub_goal: "g0" },
    { event: "finished" },
  ]);
  await other.context().close();

  await monitor(page);
  await page.locator(`[data-run="${run}"]`).click();
  await expect(page.locator(`[data-run="${run}"]`)).toContainText("left the automaton");
  const left = page.getByRole("region", { name: "Left the automaton" });
  await expect(left).toContainText(/Completed red 1 in q\d, for which there is no way/);
  await expect(page.locator(".state.departed")).toBeVisible();

  await left.getByRole("button", { name: "Promote to a demonstration" }).click();
  const preview = page.getByRole("region", { name: "Preview" });
  await expect(preview).toContainText("Newly accepted");
  await preview.getByRole("button", { name: "Apply" }).click();
  expect(await exported(page)).not.toBe(before);
  await page.getByRole("tab", { name: "History" }).click();
  await expect(page.getByRole("list", { name: "Steps" })).toContainText(/Promote run .*: yellow 1, red 1/);
  await page.keyboard.press("Control+z");
  expect(await exported(page), "it is one step").toBe(before);
});

test("nothing is edited while a run is watched", async ({ page }) => {
  await learnAndApprove(page);
  const before = await exported(page);
  await monitor(page);
  await page.locator('[data-state="q1"]').click();
  await page.keyboard.press("Delete");
  await expect(page.getByRole("status").filter({ hasText: "Runs are only watched here" })).toBeVisible();
  await page.getByRole("tab", { name: "Automaton", exact: true }).click();
  await expect(page.getByRole("region", { name: "Preview" })).toHaveCount(0);
  expect(await exported(page)).toBe(before);
});

test("the page comes back by itself when the server was away, and the run goes on", async ({ browser }) => {
  const port = String(Number(serverPort()) + 1);
  const server = new Server(port, mkdtempSync(join(tmpdir(), "goalgraph-watch-")));
  const context = await browser.newContext({ baseURL: `http://127.0.0.1:${port}` });
  try {
    await server.start(context.request);
    const page = await context.newPage();
    const approved = await learnAndApprove(page);
    const started = Robot.start(fresh("robot"), approved, ["--speed", "0.005"], port);
    robots.push(started);
    await monitor(page);
    await expect(page.locator("[data-connection]")).toHaveAttribute("data-connection", "live");
    await card(page, started).getByRole("button", { name: "Start" }).click();
    await expect(live(page)).toHaveAttribute("data-live-state", "running");

    await server.kill();
    await expect(page.locator("[data-connection]")).toContainText("Reconnecting since");
    await expect(live(page), "what was known last stays on display").toHaveAttribute("data-live-state", "running");
    await server.start(context.request);
    await expect(page.locator("[data-connection]")).toHaveAttribute("data-connection", "live");
    await expect(live(page)).toHaveAttribute("data-live-state", "finished", { timeout: 40_000 });
    await expect(page.locator("[data-event]").last()).toContainText("Finished");
  } finally {
    await server.kill();
    await context.close();
  }
});

for (const colorScheme of ["light", "dark"] as const) {
  test(`axe finds nothing serious while runs are watched, ${colorScheme}`, async ({ page }) => {
    await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
    const approved = await learnAndApprove(page);
    const started = robot(approved, "--speed", "0.005", "--becomes-unavailable", "red@1");
    await monitor(page);
    await card(page, started).getByRole("button", { name: "Start" }).click();
    await expect(page.locator("[data-replanned]")).toBeVisible();
    for (const moment of ["after a new plan", "at the end"]) {
      if (moment === "at the end") await expect(live(page)).toHaveAttribute("data-live-state", "finished");
      expect.soft(await findings(page), moment).toEqual([]);
    }
  });
}
