import { describe, expect, test } from "vitest";
import type { Path } from "../link/messages";
import { alongPath, leaderOver, rigid, seenFrom, type Leader } from "./placement";

const leader = (east_m: number, north_m: number, compass_deg: number): Leader => ({
  east_m,
  north_m,
  up_m: 1000,
  course_rad: ((90 - compass_deg) * Math.PI) / 180,
});
const offset = (forward_m: number, left_m: number, up_m = 0) => ({ forward_m, left_m, up_m });
const rounded = (place: { east_m: number; north_m: number; up_m: number }) =>
  [place.east_m, place.north_m, place.up_m].map((value) => Math.round(value) + 0);

describe("rigid slots", () => {
  test("lie behind the nose: north, east and south-west", () => {
    expect(rounded(rigid(leader(0, 0, 0))(offset(-1000, 250, 20)))).toEqual([-250, -1000, 1020]);
    expect(rounded(rigid(leader(100, 0, 90))(offset(-1000, 250)))).toEqual([-900, 250, 1000]);
    expect(rounded(rigid(leader(0, 0, 225))(offset(-1000, 0)))).toEqual([707, 707, 1000]);
  });

  test("are where the leader sees them", () => {
    const from = leader(300, -200, 77);
    const seen = seenFrom(from, rigid(from)(offset(-433, 250, -30)));
    expect(seen.forward_m).toBeCloseTo(-433, 9);
    expect(seen.left_m).toBeCloseTo(250, 9);
    expect(seen.up_m).toBeCloseTo(-30, 9);
  });
});

describe("slots along the path", () => {
  const north: Path["line"] = [
    [0, -5000, 1000],
    [0, 0, 1000],
    [0, 5000, 1100],
  ];

  test("are the rigid ones where it is straight, before and after what is known of it", () => {
    for (const north_m of [-4000, -10, 3000]) {
      const at = leader(0, north_m, 0);
      for (const slot of [offset(-1000, 250), offset(-3000, -500), offset(4000, 0)]) {
        const [east_m, north_there_m] = rounded(alongPath(at, north, 0)(slot));
        expect([east_m, north_there_m]).toEqual(rounded(rigid(at)(slot)).slice(0, 2));
      }
    }
  });

  test("climb with the path, the avoidance and their own height", () => {
    const place = alongPath(leader(0, 3000, 0), north, 200);
    expect(place(offset(-1000, 0, 30)).up_m).toBeCloseTo(1040 + 200 + 30, 6);
    expect(place(offset(9000, 0)).up_m).toBeCloseTo(1100 + 200, 6);
  });

  test("follow a turn: a slot behind a quarter circle is still on the leg before it", () => {
    const circle: Path["line"] = Array.from({ length: 91 }, (_, deg) => {
      const angle = (deg * Math.PI) / 180;
      return [1000 - 1000 * Math.cos(angle), 1000 * Math.sin(angle), 1000];
    });
    const line: Path["line"] = [[0, -3000, 1000], ...circle];
    // The leader has come round to the east; 1571 m of arc behind it the turn began.
    const place = alongPath(leader(1000, 1000, 90), line, 0);
    expect(rounded(place(offset(-Math.PI * 500 - 500, 100)))).toEqual([-100, -500, 1000]);
  });

  test("take the piece that goes the leader's way where the path crosses itself", () => {
    const eight: Path["line"] = [
      [0, -1000, 1000],
      [0, 1000, 1000],
      [1000, 1000, 1000],
      [1000, 0, 1000],
      [-1000, 0, 1000],
    ];
    expect(rounded(alongPath(leader(0, 0, 0), eight, 0)(offset(-500, 0)))).toEqual([0, -500, 1000]);
    expect(rounded(alongPath(leader(0, 0, 270), eight, 0)(offset(-500, 0)))).toEqual([500, 0, 1000]);
  });
});

test("a new leader begins where the slots lie best over its UAVs", () => {
  const flying = (east_m: number, north_m: number) => ({
    east_m,
    north_m,
    up_m: 900,
    speed_m_s: 50,
    course_rad: Math.PI / 2,
  });
  const over = leaderOver([
    { offset: offset(-1000, 250), flying: flying(-250, 0) },
    { offset: offset(-1000, -250), flying: flying(250, 20) },
  ]);
  expect(over === null ? null : rounded(over)).toEqual([0, 1010, 900]);
  expect(leaderOver([])).toBe(null);
});
