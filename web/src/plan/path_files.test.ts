import { DOMParser } from "@xmldom/xmldom";
import { describe, expect, test } from "vitest";
import type { Waypoint } from "../link/messages";
import { localFrame } from "../units/geodesy";
import { PathFileError } from "./path_file";
import { readPathFile, writePathFile } from "./path_files";
import type { PathPlan } from "./path_plan";

const kOrigin = { latitude_deg: 40.08, longitude_deg: 116.58, altitude_m: 35 };
const kFrame = localFrame(kOrigin);
const kDefaults = { up_m: 1000, speed_m_s: 50 };

const parse = (text: string) => {
  const problems: string[] = [];
  const parsed = new DOMParser({
    onError: (_level, message) => {
      problems.push(message);
    },
  }).parseFromString(text, "application/xml");
  if (problems.length > 0) throw new PathFileError(problems[0]);
  return parsed as unknown as Document;
};

const read = (text: string) => readPathFile(text, kFrame, kDefaults, parse);
const readJson = (json: unknown) => read(JSON.stringify(json));

function waypoint(east_m: number, north_m: number, rest: Partial<Waypoint> = {}): Waypoint {
  return { east_m, north_m, up_m: 1000, speed_m_s: 50, turn_radius_m: 0, ...rest };
}

const kPlan: PathPlan = {
  closed: true,
  waypoints: [
    waypoint(0, 8000),
    waypoint(12_345.678, 9000.5, { up_m: 1150.25, speed_m_s: 52.5, turn_radius_m: 1500 }),
    waypoint(9000, -20_000, { up_m: 800, speed_m_s: 52.5 }),
  ],
};

function expectSame(read_plan: PathPlan, plan: PathPlan): void {
  expect(read_plan.closed).toBe(plan.closed);
  expect(read_plan.waypoints).toHaveLength(plan.waypoints.length);
  read_plan.waypoints.forEach((point, i) => {
    const wanted = plan.waypoints[i];
    if (wanted === undefined) return;
    expect(point.speed_m_s).toBe(wanted.speed_m_s);
    expect(point.turn_radius_m).toBe(wanted.turn_radius_m);
    expect(Math.abs(point.up_m - wanted.up_m)).toBeLessThan(0.001);
    const off_m = Math.hypot(point.east_m - wanted.east_m, point.north_m - wanted.north_m);
    expect(off_m).toBeLessThan(0.001);
  });
}

describe.each(["geojson", "kml", "plan"] as const)("%s", (kind) => {
  test.each([true, false])("comes back as it was, closed: %s", (closed) => {
    const plan = { ...kPlan, closed };
    expectSame(read(writePathFile(kind, plan, [], kFrame, "Alpha")), plan);
  });

  test("holds the line as flown beside the waypoints, where it can, without taking it for a path", () => {
    const line = [
      [0, 8000, 1000],
      [10, 8100, 1000],
    ] as const;
    expectSame(read(writePathFile(kind, kPlan, line, kFrame, "A & <B>")), kPlan);
  });
});

test("altitude is flown level: 100 km away it is what the file says, not what the ellipsoid's height would be", () => {
  const far = { closed: false, waypoints: [waypoint(0, 0), waypoint(100_000, 0)] };
  expectSame(read(writePathFile("geojson", far, [], kFrame, "")), far);
});

describe("GeoJSON", () => {
  const line = (coordinates: unknown, properties: unknown = {}) => ({
    type: "Feature",
    properties,
    geometry: { type: "LineString", coordinates },
  });

  test("a line that ends where it starts is a loop", () => {
    const path = readJson(
      line([
        [116.58, 40.1, 1035],
        [116.6, 40.1, 1035],
        [116.6, 40.12, 1035],
        [116.58, 40.1, 1035],
      ]),
    );
    expect(path.closed).toBe(true);
    expect(path.waypoints).toHaveLength(3);
    expect(path.waypoints[0]?.up_m).toBeCloseTo(1000, 9);
  });

  test("without altitude and speed the defaults are taken, and that is said", () => {
    const path = readJson(
      line([
        [116.58, 40.1],
        [116.6, 40.1],
      ]),
    );
    expect(path.waypoints[1]).toMatchObject({ up_m: 1000, speed_m_s: 50 });
    expect(path.notes.join(" ")).toMatch(/no altitude .* no speed/);
  });

  test("properties count for all points of a line", () => {
    const path = readJson(
      line(
        [
          [116.58, 40.1],
          [116.6, 40.1],
        ],
        { altitude_m: 535, speed_m_s: 61, turn_radius_m: 900 },
      ),
    );
    expect(path.waypoints[1]).toMatchObject({ up_m: 500, speed_m_s: 61, turn_radius_m: 900 });
    expect(path.notes).toEqual([]);
  });

  test.each([
    [
      "far away",
      line([[16.58, 40.1, 900]]),
      /\/geometry\/coordinates\/0 lies 7979 km from the fleet's origin/,
    ],
    ["swapped", line([[40.1, 116.58, 900]]), /\/0\/1 \(latitude\) must be -90 to 90, not 116.58/],
    ["no number", line([["x", 40.1, 900]]), /\(longitude\) must be a number, not "x"/],
    ["one point", line([[116.58, 40.1, 900]]), /needs two points/],
    [
      "multi",
      { type: "Feature", geometry: { type: "MultiPoint" } },
      /\/geometry\/type: "MultiPoint" is no path/,
    ],
    ["two lines", { type: "FeatureCollection", features: [line([]), line([])] }, /more than one path/],
    ["too fast", line([[116.58, 40.1, 900]], { speed_m_s: 9000 }), /speed_m_s\) must be 1 to 400, not 9000/],
  ])("%s is refused, naming the place", (_, json, message) => {
    expect(() => readJson(json)).toThrow(message);
  });
});

describe("KML", () => {
  const kml = (inside: string) => `<?xml version="1.0"?>
    <kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark><name>Run</name>${inside}</Placemark></Document></kml>`;
  const line = (mode: string) =>
    kml(`<LineString>${mode}<coordinates> 116.58,40.1,535
      116.60,40.1,635 </coordinates></LineString>`);

  test("absolute altitudes count from the origin's", () => {
    const path = read(line("<altitudeMode>absolute</altitudeMode>"));
    expect(path.waypoints.map(({ up_m }) => Math.round(up_m))).toEqual([500, 600]);
    expect(path.notes.join(" ")).toContain("above sea level");
  });

  test("altitudes above ground are taken as above the origin, and that is said", () => {
    const path = read(line("<altitudeMode>relativeToGround</altitudeMode>"));
    expect(path.waypoints.map(({ up_m }) => Math.round(up_m))).toEqual([535, 635]);
    expect(path.notes.join(" ")).toContain("above the ground");
  });

  test("a path that lies on the ground has no altitude", () => {
    const path = read(line(""));
    expect(path.waypoints.map(({ up_m }) => up_m)).toEqual([1000, 1000]);
    expect(path.notes.join(" ")).toContain("clampToGround");
  });

  test("a polygon is a loop", () => {
    const ring = "116.58,40.1,535 116.6,40.1,535 116.6,40.12,535 116.58,40.1,535";
    const path = read(
      kml(`<Polygon><altitudeMode>absolute</altitudeMode><outerBoundaryIs><LinearRing>
        <coordinates>${ring}</coordinates></LinearRing></outerBoundaryIs></Polygon>`),
    );
    expect(path.closed).toBe(true);
    expect(path.waypoints.map(({ up_m }) => Math.round(up_m))).toEqual([500, 500, 500]);
  });

  test("a broken coordinate is named", () => {
    expect(() => read(kml("<Point><coordinates>116.58,forty</coordinates></Point>"))).toThrow(
      "Placemark “Run”: coordinate 1 is “116.58,forty”",
    );
  });

  test("other XML is named", () => {
    expect(() => read("<gpx></gpx>")).toThrow("<gpx> where KML has <kml>");
  });
});

describe("QGroundControl plan", () => {
  const at = (up_m: number, latitude_deg = 40.1) => [0, 0, 0, null, latitude_deg, 116.58, up_m];
  const item = (command: number, params: unknown, rest = {}) => ({
    type: "SimpleItem",
    frame: 3,
    command,
    params,
    ...rest,
  });
  const plan = (items: unknown[], rest = {}) => ({
    fileType: "Plan",
    mission: { items, cruiseSpeed: 20, plannedHomePosition: [40.08, 116.58, 35], ...rest },
  });

  test("speeds hold from where they are set on; before that it is the cruise speed", () => {
    const path = readJson(
      plan([
        item(16, at(500)),
        item(178, [1, 55, -1, 0, 0, 0, 0]),
        item(16, at(500, 40.2)),
        item(16, at(500, 40.3)),
      ]),
    );
    expect(path.waypoints.map(({ speed_m_s }) => speed_m_s)).toEqual([20, 55, 55]);
    expect(path.waypoints[0]?.up_m).toBe(500);
    expect(path.notes).toEqual([]);
  });

  test("altitudes above sea level count from the origin's", () => {
    const path = readJson(plan([item(16, at(535), { frame: 0 }), item(16, at(535, 40.2), { frame: 0 })]));
    expect(path.waypoints[0]?.up_m).toBe(500);
  });

  test("take-off and return are left out, and that is said", () => {
    const path = readJson(
      plan([item(22, at(50)), item(16, at(500)), item(16, at(500, 40.2)), item(20, [0, 0, 0, 0, 0, 0, 0])]),
    );
    expect(path.waypoints).toHaveLength(2);
    expect(path.notes).toEqual([
      "Item 1 (take-off 22) is left out.",
      "Item 4 (return to launch 20) is left out.",
    ]);
  });

  test("a home elsewhere is pointed out", () => {
    const path = readJson(
      plan([item(16, at(500)), item(16, at(500, 40.2))], { plannedHomePosition: [40.2, 116.58, 0] }),
    );
    expect(path.notes.join(" ")).toContain("Home of the plan is not the local origin");
  });

  test.each([
    ["terrain", plan([item(16, at(500), { frame: 10 })]), "Item 1: its altitude (frame 10) is above terrain"],
    ["survey", plan([{ type: "ComplexItem", complexItemType: "survey" }]), 'Item 1 is a "survey" pattern'],
    [
      "jump into the middle",
      plan([
        item(16, at(500), { doJumpId: 1 }),
        item(16, at(500, 40.2), { doJumpId: 2 }),
        item(177, [2, -1]),
      ]),
      "Item 3 jumps to item 2: only a loop back to the first waypoint can be flown.",
    ],
    [
      "no latitude",
      plan([item(16, [0, 0, 0, null, null, 1, 2])]),
      "Item 1 (latitude) must be a number, not null.",
    ],
    ["no items", { fileType: "Plan", mission: {} }, "The plan has no mission with items."],
  ])("%s is refused, naming the item", (_, json, message) => {
    expect(() => readJson(json)).toThrow(message);
  });
});

test.each([
  ["PK\u0003\u0004", /zipped/],
  ["hello", /neither GeoJSON nor KML/],
  ["{ broken", /broken JSON/],
  ['{"type": "Topology"}', /neither GeoJSON/],
])("%s is refused with what it is", (text, message) => {
  expect(() => read(text)).toThrow(message);
});
