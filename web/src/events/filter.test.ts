import { describe, expect, it } from "vitest";
import type { BusEvent } from "../link/messages";
import { filterEvents } from "./filter";

const event = (severity: number, vehicle_id: number, code: string, text: string): BusEvent => ({
  type: "event",
  utime: 0,
  event_node: "collision-monitor",
  event_sequence: 1,
  severity,
  code,
  vehicle_id,
  formation_id: 0,
  text,
});
const kEvents = [
  event(3, 3, "link_lost", "link of UAV3 lost: nothing heard for 4.0 s"),
  event(0, 3, "link_restored", "link of UAV3 restored after 35 s"),
  event(2, 1, "proximity_caution", "UAV1 and UAV2: caution"),
];
const codes = (text: string, least_severity = 0, ids: ReadonlySet<number> | null = null) =>
  filterEvents(kEvents, { text, least_severity, ids }, (id) => `EAGLE${id}`).map(({ code }) => code);

describe("the filter of events", () => {
  it("shows all when nothing is asked for", () => {
    expect(codes(" ")).toHaveLength(3);
  });

  it("finds all words, in any order and case, in text, code, node and callsign", () => {
    expect(codes("uav3 LOST")).toEqual(["link_lost"]);
    expect(codes("eagle3")).toEqual(["link_lost", "link_restored"]);
    expect(codes("proximity_")).toEqual(["proximity_caution"]);
    expect(codes("monitor link")).toEqual(["link_lost", "link_restored"]);
    expect(codes("uav9")).toEqual([]);
  });

  it("leaves out what is less severe, and other UAVs", () => {
    expect(codes("", 2)).toEqual(["link_lost", "proximity_caution"]);
    expect(codes("", 0, new Set([1]))).toEqual(["proximity_caution"]);
    expect(codes("", 0, new Set())).toEqual([]);
  });
});
