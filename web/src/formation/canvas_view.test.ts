import { describe, expect, test } from "vitest";
import { fitted, panned, pick, snapped, toOffset, toPixel, zoomed } from "./canvas_view";
import { shapeSlots } from "./shapes";

const slots = shapeSlots("triangle", 3, 500, 1000);
const view = fitted(slots, 150, 400, 240);

describe("the canvas", () => {
  test("shows all slots, forward up and left on the left", () => {
    const [first, left, right] = slots.map((slot) => toPixel(view, slot));
    if (first === undefined || left === undefined || right === undefined) throw new Error("three slots");
    expect(first.y).toBeLessThan(left.y);
    expect(left.x).toBeLessThan(right.x);
    for (const { x, y } of [first, left, right]) {
      expect(x).toBeGreaterThan(20);
      expect(x).toBeLessThan(380);
      expect(y).toBeGreaterThan(20);
      expect(y).toBeLessThan(220);
    }
  });

  test("comes back from pixels to the leader's frame", () => {
    const offset = { forward_m: -1234, left_m: 321 };
    const back = toOffset(view, toPixel(view, offset));
    expect(back.forward_m).toBeCloseTo(offset.forward_m, 9);
    expect(back.left_m).toBeCloseTo(offset.left_m, 9);
  });

  test("zooms about the pointer and moves with it", () => {
    const at = { x: 90, y: 40 };
    expect(toOffset(zoomed(view, 2, at), at).left_m).toBeCloseTo(toOffset(view, at).left_m, 9);
    expect(toOffset(zoomed(view, 2, at), at).forward_m).toBeCloseTo(toOffset(view, at).forward_m, 9);
    const before = toPixel(view, { forward_m: -1000, left_m: 0 });
    const after = toPixel(panned(view, { x: 15, y: -7 }), { forward_m: -1000, left_m: 0 });
    expect([after.x - before.x, after.y - before.y].map(Math.round)).toEqual([15, -7]);
  });

  test("has a scale for one slot, and for none", () => {
    expect(fitted([{ forward_m: -1000, left_m: 0 }], 150, 400, 240).px_per_m).toBeGreaterThan(0.1);
    expect(Number.isFinite(fitted([], 150, 400, 240).px_per_m)).toBe(true);
    expect(fitted(slots, 150, 10, 10).px_per_m).toBeGreaterThan(0);
  });

  test("picks the nearest slot within reach", () => {
    const { x, y } = toPixel(view, slots[1] ?? { forward_m: 0, left_m: 0 });
    expect(pick(view, slots, { x: x + 10, y }, 18)).toBe(slots[1]);
    expect(pick(view, slots, { x: x + 19, y }, 18)).toBe(null);
  });
});

test("snapping goes to the nearest step, and not at all without one", () => {
  expect(snapped(-1433, 50)).toBe(-1450);
  expect(snapped(-1433, 0)).toBe(-1433);
});
