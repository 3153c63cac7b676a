import { expect, test } from "vitest";
import { placeLabels, type LabelRequest, type PlacedLabel } from "./labels";

function request(id: number, x: number, y: number): LabelRequest {
  return {
    key: String(id),
    x,
    y,
    heading_x: 0,
    heading_y: -1,
    clearance: 18,
    width: 100,
    height: 30,
    compact_width: 40,
    compact_height: 16,
  };
}

function box(label: PlacedLabel, r: LabelRequest) {
  const left = r.x + label.dx;
  const top = r.y + label.dy;
  return { left, top, right: left + label.width, bottom: top + label.height };
}

function overlap(a: ReturnType<typeof box>, b: ReturnType<typeof box>): number {
  const w = Math.min(a.right, b.right) - Math.max(a.left, b.left);
  const h = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
  return w > 0 && h > 0 ? w * h : 0;
}

test("a lone label stands to the right of its symbol", () => {
  const [label] = placeLabels([request(1, 500, 300)], new Map());
  expect(label).toMatchObject({ dx: 18, dy: -15, compact: false });
});

test("a label makes way for the velocity vector", () => {
  const [label] = placeLabels([{ ...request(1, 500, 300), heading_x: 1, heading_y: 0 }], new Map());
  expect(label?.dx).toBe(-118);
});

test("labels of a crowd don't cover one another", () => {
  const crowd = Array.from({ length: 30 }, (_, i) =>
    request(i + 1, 300 + (i % 6) * 60, 200 + Math.floor(i / 6) * 50),
  );
  const placed = placeLabels(crowd, new Map());
  const boxes = placed.map((label) => box(label, crowd[Number(label.key) - 1] as LabelRequest));
  boxes.forEach((a, i) => {
    for (const b of boxes.slice(i + 1)) expect(overlap(a, b)).toBeLessThanOrEqual(0.04 * 100 * 30);
  });
  expect(placed.length).toBeGreaterThan(10);
  expect(placed[0]?.key).toBe("1"); // the most important keeps its label
});

test("of two UAVs at one point, both are named", () => {
  expect(placeLabels([request(1, 500, 300), request(2, 500, 300)], new Map())).toHaveLength(2);
});

test("a label keeps out of what lies over the map", () => {
  const alone = request(1, 500, 300);
  const tools = { left: 515, top: 0, right: 600, bottom: 600 };
  const [label] = placeLabels([alone], new Map(), [tools]);
  expect(label && overlap(box(label, alone), tools)).toBe(0);
});

test("what is wholly covered has no label", () => {
  const all = { left: 0, top: 0, right: 1000, bottom: 600 };
  expect(placeLabels([request(1, 500, 300)], new Map(), [all])).toEqual([]);
});

test("a label stays on its side while that is nearly as good", () => {
  const first = placeLabels([request(1, 500, 300)], new Map());
  const left: PlacedLabel = { ...(first[0] as PlacedLabel), side: 1 };
  const [label] = placeLabels([request(1, 500, 300)], new Map([["1", left]]));
  expect(label?.side).toBe(1);
});
