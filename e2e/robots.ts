import { type ChildProcess, spawn } from "node:child_process";
import { once } from "node:events";
import { resolve } from "node:path";
import { type APIRequestContext, type Page, expect } from "@playwright/test";

/** The program under test. */
export const goalgraph = resolve(import.meta.dirname, process.env.GOALGRAPH_BIN ?? "../target/debug/goalgraph");

/** A specification that the server keeps, and its approved revision. */
export type Approved = { id: string; revision: number; sha256: string };

/** Saves a specification as its first revision and approves that. */
export async function approve(request: APIRequestContext, content: string): Promise<Approved> {
  const saved = await request.post("/api/v1/specifications", { data: { content, author: "Ada" } });
  expect(saved.status(), await saved.text()).toBe(201);
  const { id, head } = await saved.json();
  return approveRevision(request, id, head.number, head.sha256, null);
}

/** Approves the last revision of the specification that was saved last. */
export async function approveLast(request: APIRequestContext): Promise<Approved> {
  const { items } = await (await request.get("/api/v1/specifications?limit=1")).json();
  const [{ id, head }] = items;
  return approveRevision(request, id, head.number, head.sha256, null);
}

/** Saves another revision on top of the last one and approves it in the place of the one before. */
export async function approveNext(request: APIRequestContext, before: Approved, content: string): Promise<Approved> {
  const address = `/api/v1/specifications/${before.id}`;
  const etag = (await request.get(address)).headers().etag;
  const saved = await request.put(address, { data: { content, author: "Ada" }, headers: { "If-Match": etag } });
  expect(saved.status(), await saved.text()).toBe(200);
  const { head } = await saved.json();
  return approveRevision(request, before.id, head.number, head.sha256, before.revision);
}

async function approveRevision(
  request: APIRequestContext,
  id: string,
  revision: number,
  sha256: string,
  insteadOf: number | null,
): Promise<Approved> {
  const signed = await request.post(`/api/v1/specifications/${id}/revisions/${revision}/approval`, {
    data: { who: "Ada", meaning: "approved for the bench", sha256, instead_of: insteadOf },
  });
  expect(signed.status(), await signed.text()).toBe(201);
  return { id, revision, sha256 };
}

/** A simulated robot in a process of its own. */
export class Robot {
  private constructor(
    readonly name: string,
    private readonly process: ChildProcess,
  ) {}

  /** Starts `goalgraph executor` at the server of the tests. */
  static start(name: string, { id }: Approved, args: string[] = [], port = serverPort()): Robot {
    const url = `ws://127.0.0.1:${port}`;
    const all = ["executor", "--url", url, "--name", name, "--specification", id, ...args];
    return new Robot(name, spawn(goalgraph, all, { stdio: "ignore" }));
  }

  /** Ends it, and waits until it has. */
  async end(): Promise<void> {
    if (this.process.exitCode !== null || this.process.signalCode !== null) return;
    const ended = once(this.process, "exit");
    this.process.kill("SIGTERM");
    await ended;
  }
}

/** A server of its own, which a test can end and start again. */
export class Server {
  private process?: ChildProcess;

  constructor(
    readonly port: string,
    private readonly data: string,
  ) {}

  /** Starts it, and waits until it is ready. */
  async start(request: APIRequestContext): Promise<void> {
    const listen = `127.0.0.1:${this.port}`;
    this.process = spawn(goalgraph, ["serve", "--listen", listen, "--data", this.data], { stdio: "ignore" });
    const ready = async () => (await request.get(`http://${listen}/api/v1/ready`)).status();
    await expect.poll(() => ready().catch(() => 0), { timeout: 15_000 }).toBe(204);
  }

  /** Ends it at once, without a word. */
  async kill(): Promise<void> {
    if (!this.process || this.process.exitCode !== null || this.process.signalCode !== null) return;
    const ended = once(this.process, "exit");
    this.process.kill("SIGKILL");
    await ended;
  }
}

/** The port of the server that the configuration starts. */
export function serverPort(): string {
  return process.env.GOALGRAPH_PORT ?? "17700";
}

/** Events of a run, as an executor reports them. */
export type Happened = { event: string } & Record<string, unknown>;

/** A robot that does what no plan says: from a page, over the real protocol, it reports these events as one run. */
export async function reportRun(page: Page, name: string, { id, sha256 }: Approved, run: string, events: Happened[]) {
  await page.evaluate(
    ({ name, id, sha256, run, events }) =>
      new Promise<void>((done, fail) => {
        const address = `ws://${location.host}/api/v1/executor?specification=${encodeURIComponent(id)}`;
        const socket = new WebSocket(address, "goalgraph.executor.v1");
        const say = (message: object) => socket.send(JSON.stringify(message));
        socket.onopen = () => say({ type: "hello", executor: name });
        socket.onerror = () => fail(new Error("no connection"));
        socket.onmessage = ({ data }) => {
          const message = JSON.parse(data);
          if (message.type === "specification") {
            say({ type: "accepted", sha256: message.sha256 });
            say({ type: "begin", run, sha256 });
          } else if (message.type === "granted") {
            events.forEach((happened, index) => say({ type: "event", run, number: index + 1, happened }));
          } else if (message.type === "acknowledged" && message.number === events.length) {
            socket.close();
            done();
          } else if (message.type === "denied" || message.type === "refused") {
            fail(new Error(message.message));
          }
        };
      }),
    { name, id, sha256, run, events },
  );
}
