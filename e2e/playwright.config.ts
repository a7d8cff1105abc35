import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { defineConfig } from "@playwright/test";

// `cargo xtask test` sets these; the defaults are for `npm test` after `cargo xtask setup`.
const server = resolve(import.meta.dirname, process.env.GOALGRAPH_BIN ?? "../target/debug/goalgraph");
const chromium = process.env.GOALGRAPH_CHROMIUM ?? "/usr/bin/chromium";
const port = process.env.GOALGRAPH_PORT ?? "17700";

const baseURL = `http://127.0.0.1:${port}`;
// The server of one run keeps what it is given in a folder of its own; workers read this file again, and do not use it.
const data = join(tmpdir(), `goalgraph-e2e-data-${port}-${process.pid}`);
const isRoot = process.getuid?.() === 0;

export default defineConfig({
  testDir: ".",
  forbidOnly: Boolean(process.env.CI),
  fullyParallel: false,
  workers: 1,
  retries: 0,
  timeout: 60_000,
  globalTimeout: 20 * 60_000,
  expect: { timeout: 15_000 },
  reporter: [["list"]],
  use: {
    baseURL,
    browserName: "chromium",
    viewport: { width: 1440, height: 900 },
    screenshot: "only-on-failure",
    trace: "retain-on-failure",
    launchOptions: {
      executablePath: chromium,
      args: [
        // Chromium's sandbox refuses to run as root.
        ...(isRoot ? ["--no-sandbox"] : []),
        "--disable-gpu",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
      ],
    },
  },
  webServer: {
    command: `"${server}" serve --listen 127.0.0.1:${port} --data "${data}"`,
    url: baseURL,
    reuseExistingServer: false,
    timeout: 30_000,
    stdout: "pipe",
    stderr: "pipe",
    env: { GOALGRAPH_LOG: "warn" },
    gracefulShutdown: { signal: "SIGTERM", timeout: 5_000 },
  },
});
