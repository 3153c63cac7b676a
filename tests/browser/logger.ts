/** LCM's own logger on the station's bus: what it writes is what the page opens. */
import { spawn, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { statSync } from "node:fs";
import { kLcmUrl } from "./station";

export class Logger {
  private child: ChildProcess | null = null;

  constructor(private readonly file: string) {}

  start(): void {
    this.child = spawn("lcm-logger", [`--lcm-url=${kLcmUrl}`, "--quiet", this.file], { stdio: "ignore" });
  }

  bytes(): number {
    return statSync(this.file, { throwIfNoEntry: false })?.size ?? 0;
  }

  /** Ends it as Ctrl-C does: it writes out what it holds. */
  async stop(): Promise<void> {
    const child = this.child;
    this.child = null;
    if (child === null || child.exitCode !== null) return;
    const ended = once(child, "exit");
    child.kill("SIGINT");
    await ended;
  }
}
