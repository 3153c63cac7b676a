import { signal } from "@preact/signals";
import { beforeEach, describe, expect, test } from "vitest";
import type { Waypoint } from "../link/messages";
import { PathDraft } from "./path_draft";
import { changeWaypoint, kStraightOn, type PathPlan } from "./path_plan";

const point = (east_m: number, north_m: number): Waypoint => ({
  east_m,
  north_m,
  up_m: 1000,
  speed_m_s: 50,
  turn_radius_m: 0,
});
const kPath: PathPlan = { closed: false, waypoints: [point(0, 0), point(0, 5000), point(5000, 5000)] };

let flown = signal(kPath);
let draft = new PathDraft(flown);

beforeEach(() => {
  flown = signal(kPath);
  draft = new PathDraft(flown);
});

describe("undo", () => {
  test("takes every kind of edit back, and does it again", () => {
    draft.insert(3, point(9000, 9000));
    draft.set(0, { up_m: 1200 }, "altitude");
    draft.setAll({ speed_m_s: 60 }, "speed");
    draft.setClosed(true);
    draft.rotate(0.3);
    draft.move(100, 0);
    draft.reverse();
    draft.remove(1);
    draft.replace(kStraightOn, "straight on");
    for (let i = 0; i < 9; i += 1) draft.undo();
    expect(draft.plan.value).toBe(kPath);
    expect(draft.changed.value).toBe(false);
    expect(draft.history.undo_label.value).toBeNull();
    for (let i = 0; i < 8; i += 1) draft.redo();
    expect(draft.plan.value.waypoints).toHaveLength(3);
    expect(draft.history.redo_label.value).toBe("straight on");
  });

  test("takes a whole drag back at once, and the next one apart", () => {
    for (const north_m of [10, 20, 30]) draft.set(1, { north_m }, "place", "drag 1");
    draft.history.endGesture();
    draft.set(1, { north_m: 40 }, "place", "drag 1");
    draft.undo();
    expect(draft.plan.value.waypoints[1]?.north_m).toBe(30);
    draft.undo();
    expect(draft.plan.value).toBe(kPath);
  });

  test("selects nothing that has gone", () => {
    draft.insert(3, point(1, 1));
    expect(draft.selected.value).toBe(3);
    draft.undo();
    expect(draft.selected.value).toBeNull();
  });
});

describe("what is flown", () => {
  const kOther = changeWaypoint(kPath, 0, { up_m: 1500 });

  test("an untouched draft goes along", () => {
    flown.value = kOther;
    expect(draft.plan.value).toBe(kOther);
    expect(draft.overtaken.value).toBe(false);
    expect(draft.history.undo_label.value).toBeNull();
  });

  test("a draft in work stays, and that another path is flown is pointed out until it is decided", () => {
    draft.remove(2);
    expect(draft.overtaken.value).toBe(false);
    flown.value = kOther;
    expect(draft.overtaken.value).toBe(true);
    expect(draft.plan.value.waypoints).toHaveLength(2);
    draft.keepMine();
    expect(draft.overtaken.value).toBe(false);
    expect(draft.changed.value).toBe(true);
  });

  test("taking what is flown can be undone", () => {
    draft.remove(2);
    flown.value = kOther;
    draft.takeFlown();
    expect(draft.changed.value).toBe(false);
    draft.undo();
    expect(draft.plan.value.waypoints).toHaveLength(2);
  });

  test("a draft that was sent is what is flown", () => {
    draft.remove(2);
    flown.value = { closed: false, waypoints: draft.plan.value.waypoints.map((old) => ({ ...old })) };
    expect(draft.changed.value).toBe(false);
    expect(draft.overtaken.value).toBe(false);
    flown.value = kOther;
    expect(draft.plan.value).toBe(kOther);
  });
});

test("two waypoints make no loop", () => {
  draft.remove(2);
  draft.setClosed(true);
  expect(draft.plan.value.closed).toBe(false);
});

test("a nudge moves what is selected, and a run of them is one step", () => {
  draft.selected.value = 1;
  draft.nudge(10, 0);
  draft.nudge(10, 0);
  expect(draft.plan.value.waypoints[1]).toMatchObject({ east_m: 20, north_m: 5000 });
  draft.undo();
  expect(draft.plan.value).toBe(kPath);
});
