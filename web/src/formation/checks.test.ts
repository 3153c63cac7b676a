import { describe, expect, test } from "vitest";
import { bodyOf, moved, newDraft, withShape } from "./draft";
import { conflictsOf, problemsOf } from "./checks";

const slot = (vehicle_id: number, forward_m: number, left_m: number, up_m = 0) => ({
  vehicle_id,
  forward_m,
  left_m,
  up_m,
});
const kCylinder = { radius_m: 150, height_m: 50 };

describe("conflicts", () => {
  test("are slots inside one another's cylinder, nearest first", () => {
    const slots = [slot(9, -1000, 0), slot(2, -1100, 0), slot(3, -1100, 100), slot(4, -2000, 0)];
    expect(conflictsOf(slots, kCylinder)).toEqual([
      { ids: [2, 3], horizontal_m: 100, vertical_m: 0 },
      { ids: [2, 9], horizontal_m: 100, vertical_m: 0 },
      { ids: [3, 9], horizontal_m: Math.hypot(100, 100), vertical_m: 0 },
    ]);
  });

  test("end where the cylinder ends: at R, and at H", () => {
    expect(conflictsOf([slot(1, 0, 0), slot(2, -150, 0)], kCylinder)).toEqual([]);
    expect(conflictsOf([slot(1, 0, 0), slot(2, 0, 0, 50)], kCylinder)).toEqual([]);
    expect(conflictsOf([slot(1, 0, 0), slot(2, -149.9, 0, -49.9)], kCylinder)).toHaveLength(1);
  });

  test("among a thousand are found in no time, and those of brute force", () => {
    const seed = Math.floor(Math.random() * 1e6);
    let state = seed;
    const next = () => (state = (state * 48271 + 11) % 2147483647) / 2147483647;
    const slots = Array.from({ length: 300 }, (_, i) =>
      slot(i + 1, -8000 * next(), 8000 * next(), 200 * next()),
    );
    const pairs = slots.flatMap((a, i) =>
      slots
        .slice(0, i)
        .filter(
          (b) =>
            Math.abs(a.up_m - b.up_m) < 50 &&
            Math.hypot(a.forward_m - b.forward_m, a.left_m - b.left_m) < 150,
        ),
    );
    expect(conflictsOf(slots, kCylinder), `seed ${seed}`).toHaveLength(pairs.length);
  });
});

describe("problems", () => {
  const draft = newDraft(1, [1, 2]);
  const check = (of = draft, others = new Map(), fleet = [1, 2, 3]) =>
    problemsOf(
      of,
      others,
      (id) => `UAV${id}`,
      (id) => fleet.includes(id),
    );

  test("are none for what can be flown", () => {
    expect(check()).toEqual([]);
    expect(check(withShape(moved(draft, new Set([1]), { forward_m: 9, left_m: 9, up_m: 0 }), "vee"))).toEqual(
      [],
    );
  });

  test("name the UAV that flies elsewhere, or nowhere", () => {
    const other = { type: "formation" as const, utime: 1, ...bodyOf(newDraft(2, [2])), name: "Bravo" };
    expect(check(draft, new Map([[2, other]]))).toEqual([
      "UAV2 flies in Bravo already: take it out there first.",
    ]);
    expect(check(draft, new Map([[1, { ...other, formation_id: 1 }]]))).toEqual([]);
    expect(check(draft, new Map(), [1])).toEqual(["UAV2 is not in the fleet."]);
  });

  test("say what thresholds must be", () => {
    expect(check({ ...draft, limits: { ...draft.limits, d_mod_m: 149 } })[0]).toContain(
      "D_mod must be at least R",
    );
    expect(check({ ...draft, limits: { ...draft.limits, caution_tau_s: 30 } })[0]).toContain("less than");
    expect(check(newDraft(1, []))[0]).toContain("no UAV");
  });
});
