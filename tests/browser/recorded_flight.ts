/** A flight with a lost link, recorded by lcm-logger into a folder that the station's bridge serves. */
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { expect, vi } from "vitest";
import { Logger } from "./logger";
import type { Screen } from "./screen";
import { kPageUrl, Station } from "./station";

export const kName = "Alarms-20261125-143000.lcm";

const until = (what: () => Promise<void>, timeout: number) => vi.waitFor(what, { timeout, interval: 50 });

export class RecordedFlight {
  readonly folder = mkdtempSync(`${tmpdir()}/skein-recordings-`);
  readonly station = new Station({ scenario: "alarms.json", bridge: ["--logs", this.folder] });
  private readonly logger = new Logger(`${this.folder}/${kName}`);

  async start(): Promise<void> {
    this.logger.start();
    this.station.start();
    await this.station.answers();
  }

  /** Flies until UAV3 is lost and the others climb away; returns how high UAV1 was at the end of the recording [m]. */
  async loseAndClimb(screen: Screen): Promise<number> {
    await until(async () => expect(await screen.text(".mode-name")).toBe("In formation"), 60_000);
    const response = await fetch(`${kPageUrl}api/command`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ channel: "CMD_LINK", body: { vehicle_id: 3, mode: "silent" } }),
    });
    expect(response.status).toBe(200);
    await until(async () => expect((await screen.uav(3)).downlink).toBe("lost"), 15_000);
    await until(async () => expect((await screen.uav(1)).altitude_m).toBeGreaterThan(1030), 30_000);
    const { altitude_m } = await screen.uav(1);
    await this.logger.stop();
    return altitude_m;
  }

  async end(): Promise<void> {
    await this.logger.stop();
    await this.station.stopAll();
    rmSync(this.folder, { recursive: true, force: true });
  }
}
