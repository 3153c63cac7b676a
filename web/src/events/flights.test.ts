import { expect, test } from "vitest";
import type { BusEvent } from "../link/messages";
import { flightStarts, startBetween } from "./flights";

const event = (t_s: number, code = "link_lost"): BusEvent => ({
  type: "event",
  utime: t_s * 1e6,
  event_node: "n",
  event_sequence: t_s,
  severity: 0,
  code,
  vehicle_id: 0,
  formation_id: 0,
  text: "",
});

test("what simulator, controller and roster tell of one start is one start", () => {
  const events = [event(101.4, "fleet_restarted"), event(100, "simulation_started"), event(50)];
  expect(flightStarts(events, 100.05e6)).toEqual([100e6]);
  expect(flightStarts([event(50)], 40e6)).toEqual([40e6]);
  expect(flightStarts([event(50)], 0)).toEqual([]);
});

test("each flight is parted from the one before it, also when its first events are not shown", () => {
  const starts = flightStarts([event(300, "fleet_restarted"), event(200, "simulation_started")], 300.5e6);
  expect(starts).toEqual([300e6, 200e6]);
  expect(startBetween(starts, event(310), event(305))).toBeNull();
  expect(startBetween(starts, event(310), event(250))).toBe(300e6);
  expect(startBetween(starts, event(200), event(199))).toBe(200e6);
});
