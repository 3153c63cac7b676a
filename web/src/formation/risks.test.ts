import { describe, expect, test } from "vitest";
import type { Approach, FlownAhead, PreviewState } from "./preview";
import { risksOf } from "./risks";

const approach = (one: number, other: number, inside_cylinder: boolean): Approach => ({
  horizontal_m: 120.4,
  vertical_m: 12,
  t_s: 33.6,
  ids: [one, other],
  inside_cylinder,
});
const done = (result: Partial<FlownAhead> | { ok: false; reason: string }): PreviewState => ({
  kind: "done",
  at_ms: 0,
  result:
    result.ok === false
      ? { ok: false, reason: result.reason }
      : {
          ok: true,
          duration_s: 60,
          complete: true,
          least: null,
          nearest: [],
          settle_s: 20,
          limits: [],
          tracks: [],
          ...result,
        },
});
const risks = (conflicts: Parameters<typeof risksOf>[0], preview: PreviewState) =>
  risksOf(conflicts, preview, (id) => `UAV${id}`).map(({ text, level }) => `${level}: ${text}`);

describe("risks", () => {
  test("are none where nobody comes near", () => {
    expect(risks([], done({ nearest: [approach(2, 3, false)] }))).toEqual([]);
    expect(risks([], { kind: "running", since_ms: 0 })).toEqual([]);
  });

  test("name who is inside whose cylinder, in the draft and on the way", () => {
    const conflicts = [
      { ids: [1, 2] as const, horizontal_m: 90, vertical_m: 0 },
      { ids: [1, 3] as const, horizontal_m: 95, vertical_m: 0 },
      { ids: [2, 3] as const, horizontal_m: 99, vertical_m: 0 },
    ];
    expect(
      risks(conflicts, done({ nearest: [approach(1, 2, true), approach(4, 5, true), approach(2, 6, true)] })),
    ).toEqual([
      "3: The slots of UAV1 and UAV2 lie inside one another’s cylinder: R 90 m, H 0 m. So do 2 more pairs.",
      "3: UAV4 and UAV5 come inside one another’s cylinder on the way: R 120 m, H 12 m after 34 s. So does 1 more pair.",
    ]);
  });

  test("are what comes after a flight that was broken off, but not after one that was long enough", () => {
    expect(risks([], done({ complete: false, duration_s: 8.4 }))).toEqual([
      "-1: Only the first 8 s could be flown ahead: what comes then is not known.",
    ]);
    expect(risks([], done({ complete: false, duration_s: 300, settle_s: null }))).toEqual([]);
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
