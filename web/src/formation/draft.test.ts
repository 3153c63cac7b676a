import { describe, expect, test } from "vitest";
import type { Formation } from "../link/messages";
import {
  bodyOf,
  differences,
  draftOf,
  moved,
  newDraft,
  swapped,
  withGain,
  withLead,
  withMembers,
  withOrder,
  withPresets,
  withShape,
  withSpacing,
  withoutMember,
} from "./draft";

const flown = (change: Partial<Formation> = {}): Formation => ({
  type: "formation",
  utime: 1,
  ...bodyOf(newDraft(1, [1, 2, 3])),
  ...change,
});
const ids = (draft: ReturnType<typeof newDraft>) => draft.slots.map((slot) => slot.vehicle_id);
const forward_m = (draft: ReturnType<typeof newDraft>) =>
  draft.slots.map((slot) => Math.round(slot.forward_m));

describe("a draft", () => {
  test("of a formation that is flown is commanded as it is flown", () => {
    const formation = flown({ control: "paper", parameters: [{ name: "k_ex", value: 2 }], radius_m: 200 });
    expect(differences(bodyOf(draftOf(formation)), formation)).toEqual([]);
  });

  test("takes a new shape and spacing, and keeps who flies in which slot and how high", () => {
    const high = moved(newDraft(1, [4, 7, 9]), new Set([7]), { forward_m: 0, left_m: 0, up_m: 60 });
    const column = withSpacing(withShape(high, "column"), 200);
    expect(forward_m(column)).toEqual([-1000, -1200, -1400]);
    expect(ids(column)).toEqual([4, 7, 9]);
    expect(column.slots[1]?.up_m).toBe(60);
  });

  test("becomes custom when a slot leaves its place, but not by height, and gets its shape back", () => {
    const draft = newDraft(1, [1, 2, 3]);
    expect(moved(draft, new Set([2]), { forward_m: 0, left_m: 0, up_m: 50 }).shape).toBe("triangle");
    const custom = moved(draft, new Set([2]), { forward_m: 10, left_m: 0, up_m: 0 });
    expect(custom.shape).toBe("custom");
    expect(bodyOf(custom).spacing_m).toBe(0);
    expect(withShape(custom, "triangle")).toEqual(draft);
  });

  test("moves with its lead, custom or not", () => {
    const draft = newDraft(1, [1, 2, 3]);
    const custom = withShape(draft, "custom");
    const back = (of: typeof draft) =>
      forward_m(withLead(of, 1500)).map((m, i) => m - (forward_m(of)[i] ?? 0));
    expect(back(draft)).toEqual([-500, -500, -500]);
    expect(back(custom)).toEqual([-500, -500, -500]);
  });

  test("lets two UAVs exchange their slots, and counts that as by hand", () => {
    const draft = swapped(newDraft(1, [1, 2, 3]), 1, 3);
    expect(ids(draft)).toEqual([3, 2, 1]);
    expect(draft.by_hand).toBe(true);
    expect(withOrder(draft, [2, 1, 3], false)).toMatchObject({ by_hand: false });
  });

  test("takes UAVs in and out, once each, and closes the gap", () => {
    const draft = withMembers(newDraft(1, [1, 2]), [2, 8]);
    expect(ids(draft)).toEqual([1, 2, 8]);
    expect(withoutMember(draft, 2).slots).toEqual(newDraft(1, [1, 8]).slots);
    const custom = withMembers(withShape(newDraft(1, [1, 2]), "custom"), [8, 9]);
    expect(forward_m(custom)).toEqual([-1000, -1500, -2000, -2500]);
  });

  test("holds gains that differ from the preset, of each law by itself", () => {
    const draft = withGain(withGain(newDraft(1, [1]), "speed_per_s", 0.9), "position_per_s", 0.3);
    expect(bodyOf(draft).parameters).toEqual([
      { name: "position_per_s", value: 0.3 },
      { name: "speed_per_s", value: 0.9 },
    ]);
    const paper = withGain({ ...draft, control: "paper" }, "k_ex", 2);
    expect(bodyOf(paper).parameters).toEqual([{ name: "k_ex", value: 2 }]);
    expect(bodyOf({ ...paper, control: "skein" }).parameters).toHaveLength(2);
    expect(bodyOf(withGain(draft, "speed_per_s", 0.7)).parameters).toHaveLength(1);
    expect(bodyOf(withPresets(draft)).parameters).toEqual([]);
  });
});

describe("differences", () => {
  const body = bodyOf(newDraft(1, [1, 2, 3]));
  test("are named", () => {
    expect(differences(body, body)).toEqual([]);
    const other = withSpacing(withShape(newDraft(1, [1, 2, 4]), "column"), 400);
    expect(differences(bodyOf(other), body)).toEqual([
      "shape",
      "spacing",
      "1 place",
      "1 more UAV",
      "1 UAV less",
    ]);
    expect(differences(bodyOf(withGain(newDraft(1, [1, 2, 3]), "speed_per_s", 1)), body)).toEqual(["gains"]);
    expect(differences({ ...body, radius_m: 100, d_mod_m: 160 }, body)).toEqual(["cylinder", "thresholds"]);
  });
  test("are none for who holds, and for what travelled as text", () => {
    expect(differences({ ...body, hold: true, lead_m: 1000 + 1e-9 }, body)).toEqual([]);
  });
});
