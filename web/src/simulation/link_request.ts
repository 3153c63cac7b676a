/** What is to become of simulated data links, as the person has chosen it, and the commands for it. */
import type { LinkBody } from "../link/messages";
import type { BusEvent } from "../link/messages";
import type { Outcome } from "../link/commands";

export type Direction = "both" | "up" | "down";
export type CutKind = "silent" | "frozen";

export interface LinkRequest {
  direction: Direction;
  kind: CutKind;
  /** 0: until restored. */
  for_s: number;
  delay_s: number;
  jitter_s: number;
  /** 0..1. */
  loss: number;
}

export type LinkAction = "cut" | "restore" | "quality";

/** The whole delay that the simulator takes [s]. */
export const kLongestDelay_s = 60;
/** The bridge lets a browser have so many commands wait. */
const kAtOnce = 12;

export function linkBody(vehicle_id: number, action: LinkAction, request: LinkRequest): LinkBody {
  const which = {
    uplink: request.direction !== "down",
    downlink: request.direction !== "up",
  };
  switch (action) {
    case "cut":
      return { vehicle_id, mode: request.kind, ...which, duration_s: request.for_s };
    case "restore":
      return { vehicle_id, mode: "up", uplink: true, downlink: true };
    case "quality": {
      const { delay_s, jitter_s, loss, for_s: duration_s } = request;
      return { vehicle_id, mode: "up", ...which, delay_s, jitter_s, loss, duration_s };
    }
  }
}

/** Why the chosen quality cannot be set, "" when it can. */
export function qualityProblem({ delay_s, jitter_s }: LinkRequest): string {
  return delay_s + jitter_s > kLongestDelay_s
    ? `Delay and jitter must be ${kLongestDelay_s} s or less together.`
    : "";
}

/** One command a UAV, a few at a time; the answer names those that were refused. */
export async function forEach(
  ids: readonly number[],
  send: (id: number) => Promise<Outcome>,
  nameOf: (id: number) => string,
): Promise<Outcome> {
  const refused = new Map<string, string[]>();
  for (let i = 0; i < ids.length; i += kAtOnce) {
    const some = ids.slice(i, i + kAtOnce);
    const outcomes = await Promise.all(some.map(send));
    outcomes.forEach(({ accepted, reason }, k) => {
      if (!accepted) refused.set(reason, [...(refused.get(reason) ?? []), nameOf(some[k] ?? 0)]);
    });
    // Nobody answers: the others would wait for it, too.
    if (refused.size > 0 && outcomes.every(({ accepted }) => !accepted)) break;
  }
  const reasons = [...refused].map(([reason, names]) =>
    ids.length === 1 ? reason : `${names.slice(0, 5).join(", ")}${names.length > 5 ? "…" : ""}: ${reason}`,
  );
  return { accepted: reasons.length === 0, reason: reasons.join("; ") };
}

const kLinkCodes = ["link_cut", "link_cut_ended", "link_set"];

/** What the simulator said last of the link of each UAV in this flight. Newest first, as the store keeps them. */
export function lastWords(events: readonly BusEvent[], start_utime: number): Map<number, BusEvent> {
  const words = new Map<number, BusEvent>();
  for (const event of events) {
    if (event.utime < start_utime) break;
    if (kLinkCodes.includes(event.code) && !words.has(event.vehicle_id)) words.set(event.vehicle_id, event);
  }
  return words;
}
