/**
 * Paths as GeoJSON (RFC 7946), the same files that `skein path upload` and `skein path show` read and write: longitude and
 * latitude in WGS-84; altitude, the third coordinate, in metres above the level of the origin plus the origin's own altitude.
 */
import type { Feature, FeatureCollection, Position } from "geojson";
import type { Waypoint } from "../link/messages";
import { wrapped, type LocalFrame } from "../units/geodesy";
import { kAltitudeRange_m, kRadiusRange_m, kSpeedRange_m_s, type PathPlan } from "./path_plan";
import {
  isObject,
  numberWithin,
  PathFileError,
  rounded,
  toLocalNearby,
  type Defaults,
  type PathFile,
} from "./path_file";

type Line = readonly (readonly [number, number, number])[];

export const kGeoJsonTypes: readonly unknown[] = [
  "FeatureCollection",
  "Feature",
  "Point",
  "LineString",
  "Polygon",
];

/** A Point for each waypoint, with its properties, and the line as it will be flown, if that is known. */
export function toGeoJson(plan: PathPlan, line: Line, frame: LocalFrame): FeatureCollection {
  const position = (east_m: number, north_m: number, up_m: number): Position => {
    const at = frame.toLatLon(east_m, north_m, up_m);
    return [
      rounded(at.longitude_deg, 10),
      rounded(at.latitude_deg, 10),
      rounded(frame.origin.altitude_m + up_m, 4),
    ];
  };
  const features: Feature[] = plan.waypoints.map((point) => ({
    type: "Feature",
    geometry: { type: "Point", coordinates: within180(position(point.east_m, point.north_m, point.up_m)) },
    properties: {
      speed_m_s: point.speed_m_s,
      turn_radius_m: point.turn_radius_m,
      closed: plan.closed,
    },
  }));
  if (line.length > 1) {
    features.unshift({
      type: "Feature",
      // Not wrapped: a line that leaps from 180 to -180 would be drawn around the world.
      geometry: { type: "LineString", coordinates: line.map((point) => position(...point)) },
      properties: { flown: true },
    });
  }
  return { type: "FeatureCollection", features };
}

function within180([longitude_deg = 0, ...others]: Position): Position {
  return [wrapped(longitude_deg), ...others];
}

/**
 * Reads a LineString, a Polygon's outer ring or Points in their order. Properties may be texts, as KML has them. A point
 * without altitude or speed has that of the point before, the first one the defaults, which is noted.
 */
export function fromGeoJson(json: unknown, frame: LocalFrame, defaults: Defaults): PathFile {
  const reader = new Reader(frame, defaults);
  reader.read(json, {}, "");
  return reader.take();
}

class Reader {
  private closed = false;
  private readonly waypoints: Waypoint[] = [];
  private readonly notes = new Set<string>();
  private lines = 0;
  private points = 0;

  constructor(
    private readonly frame: LocalFrame,
    private readonly defaults: Defaults,
  ) {}

  read(object: unknown, properties: Record<string, unknown>, where: string): void {
    if (!isObject(object)) throw new PathFileError(`${where || "The file"} must be an object.`);
    switch (object["type"]) {
      case "FeatureCollection":
        arrayOf(object["features"], `${where}/features`).forEach((feature, i) => {
          this.read(feature, {}, `${where}/features/${i}`);
        });
        return;
      case "Feature":
        this.readFeature(object, where);
        return;
      case "Point":
        this.add(object["coordinates"], properties, `${where}/coordinates`);
        this.points += 1;
        break;
      case "LineString":
        // What is drawn beside the waypoints is not a second path.
        if (isTrue(properties["flown"])) return;
        this.addLine(object["coordinates"], properties, `${where}/coordinates`);
        break;
      case "Polygon": {
        const rings = arrayOf(object["coordinates"], `${where}/coordinates`);
        if (rings.length !== 1)
          throw new PathFileError(`${where}/coordinates: a polygon must have one ring.`);
        this.addLine(rings[0], properties, `${where}/coordinates/0`);
        this.closed = true;
        break;
      }
      default:
        throw new PathFileError(
          `${where}/type: ${JSON.stringify(object["type"])} is no path; a LineString, a Polygon or Points can be read.`,
        );
    }
    if (isTrue(properties["closed"])) this.closed = true;
  }

  take(): PathFile {
    if (this.lines > 1 || (this.lines === 1 && this.points > 0)) {
      throw new PathFileError("The file holds more than one path; leave one line, or points alone.");
    }
    const [first, last] = [this.waypoints[0], this.waypoints.at(-1)];
    if (this.lines === 1 && this.waypoints.length > 2 && first !== undefined && last !== undefined) {
      const kSamePoint_m = 0.1;
      if (Math.hypot(first.east_m - last.east_m, first.north_m - last.north_m) < kSamePoint_m) {
        this.waypoints.pop();
        this.closed = true;
      }
    }
    if (this.waypoints.length < 2) throw new PathFileError("The file holds no path: that needs two points.");
    return { closed: this.closed, waypoints: this.waypoints, notes: [...this.notes] };
  }

  private readFeature(feature: Record<string, unknown>, where: string): void {
    const properties = feature["properties"];
    // A feature without a place, such as a note, is none of ours.
    if (feature["geometry"] === null) return;
    this.read(feature["geometry"], isObject(properties) ? properties : {}, `${where}/geometry`);
  }

  private addLine(coordinates: unknown, properties: Record<string, unknown>, where: string): void {
    arrayOf(coordinates, where).forEach((position, i) => {
      this.add(position, properties, `${where}/${i}`);
    });
    this.lines += 1;
  }

  private add(position: unknown, properties: Record<string, unknown>, where: string): void {
    if (!Array.isArray(position) || position.length < 2 || position.length > 3) {
      throw new PathFileError(`${where} must be [longitude, latitude] or [longitude, latitude, altitude].`);
    }
    const [longitude, latitude, third] = position as unknown[];
    const altitude = third ?? properties["altitude_m"];
    const { least, most } = kAltitudeRange_m;
    const altitude_m =
      altitude === undefined || altitude === null
        ? null
        : numberWithin(altitude, least, most, `${where} (altitude)`);
    const place = {
      longitude_deg: numberWithin(longitude, -180, 180, `${where}/0 (longitude)`),
      latitude_deg: numberWithin(latitude, -90, 90, `${where}/1 (latitude)`),
      up_m:
        altitude_m === null ? this.missing("up_m", "altitude") : altitude_m - this.frame.origin.altitude_m,
    };
    this.waypoints.push({
      ...toLocalNearby(this.frame, place, where),
      speed_m_s:
        this.optional(properties, "speed_m_s", kSpeedRange_m_s, where) ?? this.missing("speed_m_s", "speed"),
      turn_radius_m: this.optional(properties, "turn_radius_m", kRadiusRange_m, where) ?? 0,
    });
  }

  private optional(
    properties: Record<string, unknown>,
    key: string,
    { least, most }: { least: number; most: number },
    where: string,
  ): number | null {
    const value = properties[key];
    if (value === undefined || value === null) return null;
    return numberWithin(value, least, most, `${where} (property ${key})`);
  }

  private missing(key: "up_m" | "speed_m_s", name: string): number {
    const before = this.waypoints.at(-1);
    if (before !== undefined) return before[key];
    this.notes.add(`The file gives no ${name} at its first point: that of the plan is taken. Check it.`);
    return this.defaults[key];
  }
}

function arrayOf(value: unknown, where: string): unknown[] {
  if (!Array.isArray(value)) throw new PathFileError(`${where} must be an array.`);
  return value;
}

const isTrue = (value: unknown) => value === true || value === "true" || value === "1";
