/** What was asked of payloads, until telemetry follows. What is shown as on or off always comes from telemetry. */
import { effect, signal } from "@preact/signals";
import type { Commands, Outcome } from "../link/commands";
import { kPayloadOn } from "../link/frames";
import type { Store } from "../state/store";

/** Telemetry comes many times a second; a UAV that hasn't followed after so long isn't going to by itself. */
export const kPatience_ms = 5000;
/** After so long nobody waits any more: the request is history. */
const kForget_ms = 60_000;

export interface Asked {
  on: boolean;
  asked_ms: number;
}

/** "settled": as telemetry says, nothing is waited for. "late": it should have followed by now. */
export type Phase = "settled" | "pending" | "late";

export function phaseOf(asked: Asked | undefined, on: boolean | null, now_ms: number): Phase {
  if (asked === undefined || asked.on === on) return "settled";
  return now_ms - asked.asked_ms < kPatience_ms ? "pending" : "late";
}

export class PayloadRequests {
  private readonly asked = signal<ReadonlyMap<number, Asked>>(new Map());
  /** When the present flight was started; null: none is known yet. */
  private flight: number | null = null;

  constructor(
    private readonly store: Store,
    private readonly commands: Commands,
  ) {
    effect(() => {
      this.settle(store.now_ms.value);
    });
  }

  /** Asks these UAVs; all of them must carry a payload. */
  async request(ids: readonly number[], on: boolean): Promise<Outcome> {
    const outcome = await this.commands.request("CMD_PAYLOAD", { vehicle_ids: [...ids], on });
    if (outcome.accepted) {
      const asked = new Map(this.asked.value);
      for (const id of ids) asked.set(id, { on, asked_ms: this.store.now_ms.value });
      this.asked.value = asked;
    }
    return outcome;
  }

  askedOf(id: number): Asked | undefined {
    return this.asked.value.get(id);
  }

  /** Those who were asked and whose telemetry doesn't follow, by what they were asked. */
  late(now_ms: number): { on: number[]; off: number[] } {
    const result = { on: [] as number[], off: [] as number[] };
    for (const [id, asked] of this.asked.value) {
      if (phaseOf(asked, this.telemetry(id), now_ms) === "late") result[asked.on ? "on" : "off"].push(id);
    }
    return result;
  }

  /** What telemetry says; null: never heard. */
  private telemetry(id: number): boolean | null {
    const { fleet } = this.store;
    const row = fleet.motionRow(id);
    return row < 0 || fleet.motion === null ? null : (fleet.motion.flags[row] & kPayloadOn) !== 0;
  }

  private settle(now_ms: number): void {
    const flight = this.store.roster.value?.start_utime ?? this.flight;
    // In a new flight nobody was asked anything yet.
    if (this.flight !== null && flight !== this.flight) this.asked.value = new Map();
    this.flight = flight;
    const open = [...this.asked.peek()].filter(
      ([id, asked]) => asked.on !== this.telemetry(id) && now_ms - asked.asked_ms < kForget_ms,
    );
    if (open.length !== this.asked.peek().size) this.asked.value = new Map(open);
  }
}
