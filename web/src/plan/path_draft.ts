/** A formation's path while somebody works on it: every step can be undone, and it knows what is flown meanwhile. */
import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";
import type { Waypoint } from "../link/messages";
import { History } from "../state/undo";
import { samePath } from "./compare";
import {
  changeAll,
  changeWaypoint,
  insertWaypoint,
  kStraightOn,
  leastWaypoints,
  midway,
  moved,
  removeWaypoint,
  reversed,
  rotated,
  type PathPlan,
  type Place,
} from "./path_plan";

export class PathDraft {
  /** Index of the waypoint that is being worked on. */
  readonly selected = signal<number | null>(null);
  readonly plan: ReadonlySignal<PathPlan>;
  /** It is not what is flown. */
  readonly changed: ReadonlySignal<boolean>;
  /** Somebody has commanded another path since this one was begun. */
  readonly overtaken: ReadonlySignal<boolean>;
  readonly history: History<PathPlan>;
  /** What was flown when the draft was last in step with it. */
  private readonly base = signal<PathPlan>(kStraightOn);

  constructor(readonly flown: ReadonlySignal<PathPlan>) {
    this.base.value = flown.peek();
    this.history = new History(flown.peek());
    this.plan = this.history.present;
    this.changed = computed(() => !samePath(this.plan.value, this.flown.value));
    this.overtaken = computed(() => this.changed.value && !samePath(this.flown.value, this.base.value));
    effect(() => {
      this.follow(this.flown.value);
    });
  }

  /** Goes on from what is flown now; can be undone. */
  takeFlown(): void {
    this.base.value = this.flown.peek();
    this.change(this.flown.peek(), "take the path that is flown");
  }

  /** Goes on with this one, though another is flown. */
  keepMine(): void {
    this.base.value = this.flown.peek();
  }

  insert(index: number, waypoint: Waypoint): void {
    this.change(insertWaypoint(this.plan.peek(), index, waypoint), `add waypoint ${index + 1}`);
    this.selected.value = index;
  }

  /** On the leg that begins at `from`. */
  insertOnLeg(from: number, place?: Place): void {
    const { waypoints } = this.plan.peek();
    const [start, end] = [waypoints[from], waypoints[(from + 1) % waypoints.length]];
    if (start !== undefined && end !== undefined) this.insert(from + 1, { ...midway(start, end), ...place });
  }

  remove(index: number): void {
    if (this.plan.peek().waypoints[index] === undefined) return;
    this.change(removeWaypoint(this.plan.peek(), index), `delete waypoint ${index + 1}`);
    const left = this.plan.peek().waypoints.length;
    this.selected.value = left === 0 ? null : Math.min(index, left - 1);
  }

  /** Successive changes with one gesture (a drag, a field) are undone at once. */
  set(index: number, change: Partial<Waypoint>, what: string, gesture: string | null = null): void {
    this.change(changeWaypoint(this.plan.peek(), index, change), `${what} of waypoint ${index + 1}`, gesture);
  }

  nudge(east_m: number, north_m: number): void {
    const index = this.selected.peek();
    const point = index === null ? undefined : this.plan.peek().waypoints[index];
    if (index === null || point === undefined) return;
    const place = { east_m: point.east_m + east_m, north_m: point.north_m + north_m };
    this.set(index, place, "place", `nudge ${index}`);
  }

  setAll(change: Partial<Waypoint>, what: string): void {
    this.change(changeAll(this.plan.peek(), change), `${what} of all waypoints`);
  }

  setClosed(closed: boolean): void {
    const plan = this.plan.peek();
    if (closed && plan.waypoints.length < leastWaypoints(true)) return;
    this.change({ ...plan, closed }, closed ? "loop" : "open path");
  }

  reverse(): void {
    this.change(reversed(this.plan.peek()), "reverse");
    this.selected.value = null;
  }

  move(east_m: number, north_m: number, up_m = 0, gesture: string | null = null): void {
    this.change(moved(this.plan.peek(), east_m, north_m, up_m), "move the path", gesture);
  }

  rotate(clockwise_rad: number): void {
    this.change(rotated(this.plan.peek(), clockwise_rad), "turn the path");
  }

  /** Another path altogether: from a file, or none. */
  replace(plan: PathPlan, what: string): void {
    this.change(plan, what);
    this.selected.value = null;
  }

  undo(): void {
    this.history.undo();
    this.clampSelection();
  }

  redo(): void {
    this.history.redo();
    this.clampSelection();
  }

  private change(plan: PathPlan, label: string, gesture: string | null = null): void {
    this.history.change(plan, label, gesture);
  }

  private clampSelection(): void {
    if ((this.selected.peek() ?? 0) >= this.plan.peek().waypoints.length) this.selected.value = null;
  }

  /** A draft that nobody has touched is what is flown; one that has become what is flown is in step again. */
  private follow(flown: PathPlan): void {
    const base = this.base.peek();
    if (samePath(flown, base)) return;
    const plan = this.plan.peek();
    if (samePath(plan, base)) {
      this.history.reset(flown);
      this.selected.value = null;
      this.base.value = flown;
    } else if (samePath(plan, flown)) {
      this.base.value = flown;
    }
  }
}
