/** Keeps the curves that are drawn: the flight so far from the bridge, then what the live link brings. */
import { signal } from "@preact/signals";
import { kHasSlot } from "../link/frames";
import type { Api } from "../link/api";
import { kLinkLost, type Fleet } from "../state/fleet";
import type { Store } from "../state/store";
import type { Player } from "../timeline/player";
import { FlightSeries, type ColumnName } from "./flight_series";
import { appendHistory, decodeHistory } from "./history_frame";

/** Live samples are this far apart at least; status comes twice a second. */
const kLiveEvery_s = 0.5;
/** As the bridge: what was not heard for so long is a gap. */
const kOldAfter_s = 2;
const kTryAgain_ms = 3000;
/** Time that goes back so far is a recording that was wound back. */
const kWoundBack_s = 2;
const kGrown_s = 30;

export type Loading = { kind: "idle" } | { kind: "loading" } | { kind: "failed"; reason: string };

export class FlightCurves {
  series = new FlightSeries([]);
  readonly loading = signal<Loading>({ kind: "idle" });
  /** Which flight `series` is of. */
  private start_utime = 0;
  private abort = new AbortController();
  private wanted = "";
  private failed_ms = -Infinity;

  constructor(
    private readonly store: Store,
    private readonly api: Api,
    private readonly player: Player,
  ) {}

  /** On each beat: fetches when other UAVs, another flight or another connection are there, and adds what is new. */
  update(ids: readonly number[], now_ms: number): void {
    const roster = this.store.roster.value;
    const connected = this.store.connection.value.kind === "open";
    const hello = this.store.hello.value;
    if (roster === null || hello === null || !connected) return;
    const recording = this.player.name.value;
    // A recording has all of its flight at once; one that is being written has more every now and then.
    const which =
      recording === ""
        ? String(hello.utime)
        : `${recording}/${Math.floor(this.player.duration_s() / kGrown_s)}`;
    const wanted = `${ids.join()}/${roster.start_utime}/${which}`;
    const again = this.loading.value.kind === "failed" && now_ms - this.failed_ms > kTryAgain_ms;
    if (wanted !== this.wanted || again) {
      this.wanted = wanted;
      void this.fetch(ids, roster.start_utime);
    }
    if (recording !== "") return;
    if (this.loading.value.kind === "idle" && roster.start_utime === this.start_utime) this.appendLive();
  }

  /** Stops what is under way. */
  close(): void {
    this.abort.abort();
    this.wanted = "";
  }

  private async fetch(ids: readonly number[], start_utime: number): Promise<void> {
    this.abort.abort();
    const abort = new AbortController();
    this.abort = abort;
    // The same UAVs in the same flight: only what was missed.
    const goes_on = start_utime === this.start_utime && ids.join() === this.series.ids.join();
    const series = goes_on ? this.series : new FlightSeries(ids);
    if (ids.length > 0) {
      this.loading.value = { kind: "loading" };
      const since = goes_on && series.count > 0 ? `&since=${series.last_s()}` : "";
      try {
        const bytes = await this.api.getBytes(
          `api/history?ids=${ids.join()}${since}${this.recordingQuery()}`,
          abort.signal,
        );
        const frame = decodeHistory(bytes);
        if (frame === null) throw new Error("web-bridge sent a history that this page can't read.");
        // Between the roster here and the history there another flight may have begun: then a roster comes, too.
        if (frame.start_utime === start_utime) appendHistory(series, frame);
      } catch (error) {
        if (abort.signal.aborted) return;
        this.failed_ms = performance.now();
        this.loading.value = {
          kind: "failed",
          reason: error instanceof Error ? error.message : String(error),
        };
        return;
      }
    }
    this.series = series;
    this.start_utime = start_utime;
    this.loading.value = { kind: "idle" };
  }

  /** Which recording, and which of its flights: the one at the time that is played. */
  private recordingQuery(): string {
    const name = this.player.name.peek();
    if (name === "") return "";
    return `&recording=${encodeURIComponent(name)}&at=${this.player.at_s(performance.now()).toFixed(3)}`;
  }

  private appendLive(): void {
    const { fleet } = this.store;
    const t_s = fleet.motion?.t_s ?? -1;
    if (t_s >= 0 && t_s < this.series.last_s() - kWoundBack_s)
      this.series = new FlightSeries(this.series.ids);
    if (t_s < 0 || t_s - this.series.last_s() < kLiveEvery_s) return;
    this.series.append(t_s, (id, name) => liveValue(fleet, id, name));
  }
}

/** A value out of the newest frames; NaN: not known. */
export function liveValue(fleet: Fleet, id: number, name: ColumnName): number {
  const { motion, status } = fleet;
  const m = fleet.motionRow(id);
  const s = fleet.statusRow(id);
  switch (name) {
    case "up_m":
    case "speed_m_s":
    case "course_rad":
      return motion === null || m < 0 || motion.age_s[m] > kOldAfter_s || status?.downlink[s] === kLinkLost
        ? NaN
        : motion[name][m];
    case "forward_error_m":
    case "left_error_m":
    case "up_error_m":
      return status === null || s < 0 || (status.flags[s] & kHasSlot) === 0 ? NaN : status[name][s];
    default:
      return status === null || s < 0 || status[name][s] < 0 ? NaN : status[name][s];
  }
}
