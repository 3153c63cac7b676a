/**
 * Paths as QGroundControl's plan files (docs.qgroundcontrol.com, "Plan File Format"): MAVLink mission items. A speed
 * (DO_CHANGE_SPEED) holds for the items after it, so the one before a waypoint is what that waypoint is passed at; a jump
 * from the end to the first waypoint (DO_JUMP) is a loop. Altitudes are above home, which is the local origin.
 * The format has no turn radius: it goes into a key of our own, which QGroundControl ignores.
 */
import type { Waypoint } from "../link/messages";
import { wrapped, type LocalFrame } from "../units/geodesy";
import {
  isObject,
  numberWithin,
  PathFileError,
  rounded,
  toLocal,
  toLocalNearby,
  type Defaults,
  type PathFile,
} from "./path_file";
import { kAltitudeRange_m, kRadiusRange_m, kSpeedRange_m_s, type PathPlan } from "./path_plan";

/** MAV_CMD and MAV_FRAME. */
const kNavWaypoint = 16;
const kNavSplineWaypoint = 82;
const kDoJump = 177;
const kDoChangeSpeed = 178;
const kFrameGlobal: readonly unknown[] = [0, 5];
const kFrameMission = 2;
const kFrameRelative: readonly unknown[] = [3, 6];
const kFrameTerrain: readonly unknown[] = [10, 11];

const kLoiters: readonly unknown[] = [17, 18, 19, 31];
const kNames: Readonly<Record<number, string>> = {
  20: "return to launch",
  21: "land",
  22: "take-off",
  84: "take-off",
  85: "land",
  189: "start of landing",
};

export function toQgcPlan(plan: PathPlan, frame: LocalFrame): unknown {
  const items: Record<string, unknown>[] = [];
  const add = (item: Record<string, unknown>) => {
    items.push({ type: "SimpleItem", autoContinue: true, doJumpId: items.length + 1, ...item });
  };
  let speed_m_s: number | null = null;
  let first_id = 1;
  plan.waypoints.forEach((point, i) => {
    if (point.speed_m_s !== speed_m_s) {
      speed_m_s = point.speed_m_s;
      // Ground speed, throttle unchanged.
      add({ command: kDoChangeSpeed, frame: kFrameMission, params: [1, speed_m_s, -1, 0, 0, 0, 0] });
    }
    if (i === 0) first_id = items.length + 1;
    const at = frame.toLatLon(point.east_m, point.north_m, point.up_m);
    const altitude_m = rounded(point.up_m, 4);
    add({
      command: kNavWaypoint,
      frame: 3,
      params: [
        0,
        0,
        0,
        null,
        rounded(at.latitude_deg, 10),
        rounded(wrapped(at.longitude_deg), 10),
        altitude_m,
      ],
      AMSLAltAboveTerrain: null,
      Altitude: altitude_m,
      AltitudeMode: 1,
      turn_radius_m: point.turn_radius_m,
    });
  });
  if (plan.closed) add({ command: kDoJump, frame: kFrameMission, params: [first_id, -1, 0, 0, 0, 0, 0] });
  const { latitude_deg, longitude_deg, altitude_m } = frame.origin;
  const cruise_m_s = plan.waypoints[0]?.speed_m_s ?? 50;
  return {
    fileType: "Plan",
    version: 1,
    groundStation: "QGroundControl",
    geoFence: { circles: [], polygons: [], version: 2 },
    rallyPoints: { points: [], version: 2 },
    mission: {
      version: 2,
      firmwareType: 0, // MAV_AUTOPILOT_GENERIC
      vehicleType: 1, // MAV_TYPE_FIXED_WING
      globalPlanAltitudeMode: 1, // relative to home
      cruiseSpeed: cruise_m_s,
      hoverSpeed: cruise_m_s,
      plannedHomePosition: [latitude_deg, longitude_deg, altitude_m],
      items,
    },
  };
}

export function fromQgcPlan(json: unknown, frame: LocalFrame, defaults: Defaults): PathFile {
  const mission = isObject(json) ? json["mission"] : undefined;
  if (!isObject(mission) || !Array.isArray(mission["items"])) {
    throw new PathFileError("The plan has no mission with items.");
  }
  const reader = new Reader(frame, defaults, mission);
  (mission["items"] as unknown[]).forEach((item, i) => {
    reader.readItem(item, `Item ${i + 1}`);
  });
  return reader.take();
}

class Reader {
  private readonly waypoints: Waypoint[] = [];
  private readonly notes = new Set<string>();
  private speed_m_s: number | null = null;
  private first_id: number | null = null;
  private closed = false;

  constructor(
    private readonly frame: LocalFrame,
    private readonly defaults: Defaults,
    private readonly mission: Record<string, unknown>,
  ) {
    this.noteHome();
  }

  readItem(item: unknown, where: string): void {
    if (!isObject(item)) throw new PathFileError(`${where} must be an object.`);
    if (item["type"] !== "SimpleItem") {
      throw new PathFileError(
        `${where} is a ${JSON.stringify(item["complexItemType"] ?? item["type"])} pattern: only single waypoints can be read.`,
      );
    }
    const { command } = item;
    const params = Array.isArray(item["params"]) ? (item["params"] as unknown[]) : [];
    if (this.closed) {
      this.notes.add(`${where} and what follows lie behind the loop and are left out.`);
    } else if (command === kNavWaypoint || command === kNavSplineWaypoint || kLoiters.includes(command)) {
      if (kLoiters.includes(command)) this.notes.add(`${where} loiters: it is flown by as a waypoint.`);
      if (command === kNavSplineWaypoint) this.notes.add(`${where} is a spline: it is flown with arcs.`);
      this.addWaypoint(item, params, where);
    } else if (command === kDoChangeSpeed) {
      const { least, most } = kSpeedRange_m_s;
      this.speed_m_s = numberWithin(params[1], least, most, `${where} (speed)`);
    } else if (command === kDoJump) {
      this.jump(params, where);
    } else {
      const name = typeof command === "number" ? kNames[command] : undefined;
      this.notes.add(`${where} (${name ?? "command"} ${String(command)}) is left out.`);
    }
  }

  take(): PathFile {
    if (this.waypoints.length < 2)
      throw new PathFileError("The plan holds no path: that needs two waypoints.");
    return { closed: this.closed, waypoints: this.waypoints, notes: [...this.notes] };
  }

  private addWaypoint(item: Record<string, unknown>, params: readonly unknown[], where: string): void {
    const { least, most } = kAltitudeRange_m;
    const place = {
      latitude_deg: numberWithin(params[4], -90, 90, `${where} (latitude)`),
      longitude_deg: numberWithin(params[5], -180, 180, `${where} (longitude)`),
      up_m: this.up_m(item["frame"], numberWithin(params[6], least, most, `${where} (altitude)`), where),
    };
    const radius_m = item["turn_radius_m"] ?? 0;
    this.waypoints.push({
      ...toLocalNearby(this.frame, place, where),
      speed_m_s: this.speed_m_s ?? this.cruise_m_s(),
      turn_radius_m: numberWithin(
        radius_m,
        kRadiusRange_m.least,
        kRadiusRange_m.most,
        `${where} (turn radius)`,
      ),
    });
    if (typeof item["doJumpId"] === "number") this.first_id ??= item["doJumpId"];
  }

  private up_m(altitude_frame: unknown, altitude_m: number, where: string): number {
    if (kFrameRelative.includes(altitude_frame)) return altitude_m;
    if (kFrameGlobal.includes(altitude_frame)) {
      this.notes.add("Altitudes above sea level are taken on the same reference as the origin's altitude.");
      return altitude_m - this.frame.origin.altitude_m;
    }
    const why = kFrameTerrain.includes(altitude_frame)
      ? "is above terrain, of which nothing is known"
      : "can't be read";
    throw new PathFileError(`${where}: its altitude (frame ${String(altitude_frame)}) ${why}.`);
  }

  private jump(params: readonly unknown[], where: string): void {
    const target = numberWithin(params[0], 0, 1e6, `${where} (item to jump to)`);
    if (this.first_id === null || target > this.first_id) {
      throw new PathFileError(
        `${where} jumps to item ${target}: only a loop back to the first waypoint can be flown.`,
      );
    }
    if (params[1] !== -1) this.notes.add(`${where}: the loop is flown until something else is commanded.`);
    this.closed = true;
  }

  private cruise_m_s(): number {
    const speed = this.mission["cruiseSpeed"];
    const { least, most } = kSpeedRange_m_s;
    if (typeof speed === "number" && speed >= least && speed <= most) return speed;
    this.notes.add("The plan gives no speed: that of the plan on the screen is taken. Check it.");
    return this.defaults.speed_m_s;
  }

  private noteHome(): void {
    const home = this.mission["plannedHomePosition"];
    if (!Array.isArray(home)) return;
    const [latitude_deg, longitude_deg, altitude_m] = home as unknown[];
    if (typeof latitude_deg !== "number" || typeof longitude_deg !== "number") return;
    const at = toLocal(this.frame, { latitude_deg, longitude_deg, up_m: 0 });
    const kSamePlace_m = 100;
    if (Math.hypot(at.east_m, at.north_m) > kSamePlace_m) {
      this.notes.add(
        "Home of the plan is not the local origin; altitudes above home are taken as above the origin.",
      );
      return;
    }
    const above_m = typeof altitude_m === "number" ? altitude_m - this.frame.origin.altitude_m : 0;
    const kSameHeight_m = 1;
    if (Math.abs(above_m) > kSameHeight_m) {
      this.notes.add(
        `Home of the plan lies ${Math.round(Math.abs(above_m))} m ${above_m > 0 ? "above" : "below"} the local origin; altitudes above home are taken as above the origin.`,
      );
    }
  }
}
