/** What differs between two paths, in sentences: for the review before sending, and for what is read back after it. */
import type { Waypoint } from "../link/messages";
import { altitude, distance, kAltitudeReference, speed } from "../units/quantities";
import type { PathPlan } from "./path_plan";

/** Text on the way keeps more digits than anybody can fly. */
const kSamePlace_m = 0.01;
const kSameSpeed_m_s = 0.001;

export function samePath(a: PathPlan, b: PathPlan): boolean {
  if (a === b) return true;
  // One waypoint or none is no loop, whatever it is called.
  const closed = (plan: PathPlan) => plan.closed && plan.waypoints.length > 0;
  return (
    closed(a) === closed(b) &&
    a.waypoints.length === b.waypoints.length &&
    a.waypoints.every((point, i) => sameWaypoint(point, b.waypoints[i]))
  );
}

function sameWaypoint(a: Waypoint, b: Waypoint | undefined): boolean {
  return (
    b !== undefined &&
    Math.hypot(a.east_m - b.east_m, a.north_m - b.north_m) < kSamePlace_m &&
    Math.abs(a.up_m - b.up_m) < kSamePlace_m &&
    Math.abs(a.speed_m_s - b.speed_m_s) < kSameSpeed_m_s &&
    Math.abs(a.turn_radius_m - b.turn_radius_m) < kSamePlace_m
  );
}

/** Empty exactly when both are the same path. */
export function differences(before: PathPlan, after: PathPlan): string[] {
  if (samePath(before, after)) return [];
  if (after.waypoints.length === 0) {
    return [`Straight on: all ${before.waypoints.length} waypoints are dropped.`];
  }
  if (before.waypoints.length === 0) {
    return [`A new path of ${after.waypoints.length} waypoints${after.closed ? ", flown as a loop" : ""}.`];
  }
  const sentences = waypointChanges(before.waypoints, after.waypoints);
  if (before.closed !== after.closed) {
    sentences.unshift(
      after.closed ? "The path becomes a loop." : "The path is no loop any more: it ends in a circle.",
    );
  }
  return sentences;
}

/** What is alike at both ends is left out; what is in between has changed, come or gone. */
function waypointChanges(before: readonly Waypoint[], after: readonly Waypoint[]): string[] {
  const shorter = Math.min(before.length, after.length);
  let head = 0;
  while (head < shorter && sameWaypoint(at(before, head), at(after, head))) head += 1;
  let tail = 0;
  while (tail < shorter - head && sameWaypoint(at(before, -1 - tail), at(after, -1 - tail))) tail += 1;
  const gone = before.length - head - tail;
  const come = after.length - head - tail;
  if (gone === come) {
    return Array.from({ length: gone }, (_, i) =>
      changes(at(before, head + i), at(after, head + i), head + i + 1),
    );
  }
  if (gone === 0) {
    const which = range(head + 1, come);
    return [`${capital(which)} ${come === 1 ? "is" : "are"} new.`];
  }
  if (come === 0)
    return [`${capital(range(head + 1, gone))} of the old path ${gone === 1 ? "is" : "are"} dropped.`];
  return [
    `${capital(range(head + 1, gone))} of the old path ${gone === 1 ? "gives" : "give"} way to ${range(head + 1, come)} of the new one.`,
  ];
}

function changes(before: Waypoint, after: Waypoint, number: number): string {
  const moved_m = Math.hypot(after.east_m - before.east_m, after.north_m - before.north_m);
  const parts = [
    moved_m >= kSamePlace_m ? `moves ${lengthText(moved_m)}` : "",
    Math.abs(after.up_m - before.up_m) >= kSamePlace_m
      ? `altitude ${altitude.text(before.up_m)} → ${altitude.text(after.up_m)} ${altitude.unit()} ${kAltitudeReference}`
      : "",
    Math.abs(after.speed_m_s - before.speed_m_s) >= kSameSpeed_m_s
      ? `speed ${speed.text(before.speed_m_s, 1)} → ${speed.full(after.speed_m_s, 1)}`
      : "",
    Math.abs(after.turn_radius_m - before.turn_radius_m) >= kSamePlace_m
      ? `turn radius ${radiusText(before.turn_radius_m)} → ${radiusText(after.turn_radius_m)}`
      : "",
  ].filter(Boolean);
  return parts.length === 0 ? `Waypoint ${number}: as before.` : `Waypoint ${number}: ${parts.join("; ")}.`;
}

const lengthText = (metres: number) => distance.full(metres, metres < 10 ? 2 : 0);

export function radiusText(radius_m: number): string {
  return radius_m === 0 ? "the smallest in comfort" : distance.full(radius_m);
}

function range(first: number, count: number): string {
  if (count === 1) return `waypoint ${first}`;
  return `waypoints ${first}${count === 2 ? " and " : " to "}${first + count - 1}`;
}

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

function at(list: readonly Waypoint[], index: number): Waypoint {
  const found = list.at(index);
  if (found === undefined) throw new RangeError(`no waypoint ${index}`);
  return found;
}
