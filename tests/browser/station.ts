/** The ground station's processes, real ones, on a bus and a port that nobody else uses. */
import { spawn, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { fileURLToPath } from "node:url";
import { onTestFailed } from "vitest";

const kHere = fileURLToPath(new URL(".", import.meta.url));
export const kBin = process.env["SKEIN_BIN"] ?? `${kHere}../../build/bin`;
/** Files run side by side, each on a bus and a port of its own: the first ones are given, the next files count on. */
const kWorker = Number(process.env["VITEST_POOL_ID"] ?? "1") - 1;
const kFirstLcmPort = Number(process.env["SKEIN_TEST_LCM_PORT"] ?? "7707");
const kFirstPort = Number(process.env["SKEIN_TEST_PORT"] ?? "8107");
export const kLcmUrl = `udpm://239.255.76.67:${kFirstLcmPort + kWorker}?ttl=0`;
export const kPort = String(kFirstPort + kWorker);
const kWeb = `${kHere}../../web/dist`;

const kNodes = ["web-bridge", "fleet-simulator", "formation-controller", "collision-monitor"] as const;
/** flight-recorder is started only where it is named. */
export type NodeName = (typeof kNodes)[number] | "flight-recorder";
export const kPageUrl = `http://127.0.0.1:${kPort}/`;

interface Running {
  process: ChildProcess;
  /** The end of what it said, for when a test fails. */
  output: string;
}

export interface StationOptions {
  /** A file in tests/browser/scenarios. */
  scenario: string;
  /** More arguments for web-bridge. */
  bridge?: readonly string[];
}

/** In a test: should it fail, what the processes said last is shown. */
export function explain(...stations: readonly Station[]): void {
  onTestFailed(() => {
    process.stderr.write(stations.map((station) => `${station.log()}\n`).join(""));
  });
}

export class Station {
  private readonly running = new Map<NodeName, Running>();
  /** Where flight-recorder records; gone with `stopAll`. */
  private recordings = "";

  constructor(private readonly options: StationOptions) {}

  private argumentsOf(name: NodeName): string[] {
    if (name === "flight-recorder") {
      this.recordings ||= mkdtempSync(`${tmpdir()}/skein-browser-logs-`);
      return ["--folder", this.recordings, "--keep-free-gb", "0"];
    }
    return name === "web-bridge"
      ? ["--port", kPort, "--web", kWeb, ...(this.options.bridge ?? [])]
      : ["--scenario", `${kHere}scenarios/${this.options.scenario}`];
  }

  /** Which bus a process is told; none when it serves recordings alone. */
  private busOf(name: NodeName): string[] {
    const alone = name === "web-bridge" && /^--(no-bus|log)$/m.test((this.options.bridge ?? []).join("\n"));
    return alone ? [] : ["--lcm-url", kLcmUrl];
  }

  /** All of them unless some are named. */
  start(...names: NodeName[]): void {
    for (const name of names.length === 0 ? kNodes : names) {
      const child = spawn(`${kBin}/${name}`, [...this.argumentsOf(name), ...this.busOf(name)], {
        stdio: ["ignore", "pipe", "pipe"],
        env: { ...process.env, SKEIN_SCENARIOS: `${kHere}scenarios` },
      });
      const running: Running = { process: child, output: "" };
      const listen = (chunk: Buffer) => {
        running.output = (running.output + chunk.toString()).slice(-4000);
      };
      child.stdout.on("data", listen);
      child.stderr.on("data", listen);
      child.on("error", (error) => {
        running.output += String(error);
      });
      this.running.set(name, running);
    }
  }

  /** Ends processes as an operator would, and waits until they are gone. */
  async stop(...names: NodeName[]): Promise<void> {
    await Promise.all(
      names.map(async (name) => {
        const child = this.running.get(name)?.process;
        this.running.delete(name);
        if (child === undefined || child.pid === undefined || child.exitCode !== null) return;
        const ended = once(child, "exit");
        child.kill("SIGTERM");
        const stubborn = setTimeout(() => child.kill("SIGKILL"), 5000);
        await ended;
        clearTimeout(stubborn);
      }),
    );
  }

  async stopAll(): Promise<void> {
    await this.stop(...this.running.keys());
    if (this.recordings !== "") rmSync(this.recordings, { recursive: true, force: true });
  }

  /** Kills the lcm-logger of flight-recorder outright. */
  killLogger(): void {
    const pid = this.running.get("flight-recorder")?.process.pid ?? 0;
    const children = readFileSync(`/proc/${pid}/task/${pid}/children`, "utf8").trim().split(" ");
    const [logger] = children.map(Number);
    if (logger === undefined || !(logger > 1)) throw new Error("flight-recorder has no lcm-logger");
    process.kill(logger, "SIGKILL");
  }

  /** Waits until the bridge that runs now has heard a node. */
  async hears(node: NodeName, timeout_ms = 20_000): Promise<void> {
    const deadline = Date.now() + timeout_ms;
    for (;;) {
      const health = (await fetch(`${kPageUrl}api/health`).then(
        (response) => response.json(),
        () => ({ nodes: [] }),
      )) as { nodes: string[] };
      if (health.nodes.includes(node)) return;
      if (Date.now() > deadline) throw new Error(`web-bridge doesn't hear ${node}\n${this.log()}`);
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }

  /** What the processes said last. */
  log(): string {
    return [...this.running].map(([name, { output }]) => `--- ${name}\n${output}`).join("\n");
  }

  /** Waits until the bridge serves the page. */
  async answers(timeout_ms = 20_000): Promise<void> {
    const deadline = Date.now() + timeout_ms;
    for (;;) {
      const ok = await fetch(kPageUrl).then(
        (response) => response.ok,
        () => false,
      );
      if (ok) return;
      if (Date.now() > deadline) throw new Error(`web-bridge doesn't answer at ${kPageUrl}\n${this.log()}`);
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }
}
