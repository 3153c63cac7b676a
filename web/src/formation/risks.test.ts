import { describe, expect, test } from "vitest";
import type { FormationPreview, PreviewState } from "./preview";
import { risksOf } from "./risks";

const done = (change: Partial<FormationPreview>): PreviewState => ({
  kind: "done",
  at_ms: 0,
  result: {
    ok: true,
    reason: "",
    duration_s: 60,
    least: null,
    settle_s: 20,
    limits: [],
    tracks: [],
    ...change,
  },
});
const least = { horizontal_m: 120.4, vertical_m: 12, t_s: 33.6, ids: [2, 3] as [number, number] };
const risks = (conflicts: Parameters<typeof risksOf>[0], preview: PreviewState) =>
  risksOf(conflicts, preview, (id) => `UAV${id}`).map(({ text, level }) => `${level}: ${text}`);

describe("risks", () => {
  test("are none where nobody comes near", () => {
    expect(risks([], done({ least: { ...least, inside_cylinder: false } }))).toEqual([]);
    expect(risks([], { kind: "running", since_ms: 0 })).toEqual([]);
  });

  test("name who is inside whose cylinder, in the draft and on the way", () => {
    const conflicts = [
      { ids: [1, 2] as const, horizontal_m: 90, vertical_m: 0 },
      { ids: [1, 3] as const, horizontal_m: 95, vertical_m: 0 },
      { ids: [2, 3] as const, horizontal_m: 99, vertical_m: 0 },
    ];
    expect(risks(conflicts, done({ least: { ...least, inside_cylinder: true } }))).toEqual([
      "3: The slots of UAV1 and UAV2 are inside one another’s cylinder: R 90 m, H 0 m. So are 2 more pairs.",
      "3: UAV2 and UAV3 come inside one another’s cylinder on the way: R 120 m, H 12 m after 34 s.",
    ]);
  });

  test("are that nobody knows, when it could not be flown ahead", () => {
    expect(risks([], { kind: "failed", reason: "web-bridge answered 404." })).toEqual([
      "-1: It could not be flown ahead: web-bridge answered 404.",
    ]);
    expect(risks([], done({ ok: false, reason: "its path cannot be flown" }))).toEqual([
      "-1: The station would refuse it: its path cannot be flown",
    ]);
  });
});
