/** What the server says of a plan: its arcs and problems at once, the whole formation's flight along it a moment later. */
import { signal } from "@preact/signals";
import type { Api } from "../link/api";
import type { PathPlan } from "./path_plan";

export interface PathProblem {
  waypoint_index: number;
  /** On the leg that begins there. */
  on_leg: boolean;
  text: string;
}

/** cpp/bridge/README.md, POST /api/preview/path. */
export interface PathPreview {
  ok: boolean;
  reason: string;
  line: [number, number, number][];
  /** `from` null: from where the leader is. */
  legs: { from: number | null; to: number; length_m: number; time_s: number; course_rad: number }[];
  problems: PathProblem[];
}

export interface FlightPreview extends PathPreview {
  duration_s: number;
  complete: boolean;
  computed_ms: number;
  least: {
    horizontal_m: number;
    vertical_m: number;
    t_s: number;
    ids: [number, number];
    inside_cylinder: boolean;
  } | null;
  limits: { vehicle_id: number; limit: string; t_s: number; seconds: number }[];
  tracks: { id: number; points: [number, number, number, number][] }[];
}

/** An answer, and what it is about: an older one stays in sight until the next comes. */
export interface Answer<T> {
  plan: PathPlan;
  preview: T;
  /** performance.now() when it came. */
  at_ms: number;
}

export const kQuiet_ms = 500;
export const kFlightOld_ms = 15_000;
/** Of the time a flight takes the server, how often it is left alone. */
const kLeastRest = 10;

/** Asks for the newest plan only: geometry one after the other, the flight once nothing has changed for a while. */
export class Preview {
  readonly geometry = signal<Answer<PathPreview> | null>(null);
  readonly flight = signal<Answer<FlightPreview> | null>(null);
  readonly flying = signal(false);
  /** Why there is no answer; "" while there is one, or will be. */
  readonly failure = signal("");
  private wanted: { formation_id: number; plan: PathPlan } | null = null;
  private asking = false;
  private abort = new AbortController();
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly api: Pick<Api, "postJson">) {}

  /** Asks about a plan; a flight of an older one is given up. */
  want(formation_id: number, plan: PathPlan): void {
    this.cancelFlight();
    if (this.wanted?.formation_id !== formation_id) this.forget();
    this.wanted = { formation_id, plan };
    void this.ask();
  }

  /** Asks once more, as the formation has flown on; the flight only when it is old, and never most of the time. */
  async refresh(): Promise<void> {
    const { wanted } = this;
    if (wanted === null || this.asking) return;
    await this.askGeometry(wanted);
    if (wanted !== this.wanted || this.flying.peek() || this.timer !== undefined) return;
    if (this.geometry.peek()?.preview.ok !== true) return;
    const flight = this.flight.peek();
    // When it has failed before, or could not be asked for.
    if (flight?.plan !== wanted.plan) return this.fly(wanted);
    const age_ms = performance.now() - flight.at_ms;
    const old_ms = Math.max(kFlightOld_ms, kLeastRest * flight.preview.computed_ms);
    if (age_ms > old_ms) await this.fly(wanted);
  }

  /** Asks for nothing any more. */
  stop(): void {
    this.cancelFlight();
    this.wanted = null;
    this.forget();
  }

  private forget(): void {
    this.geometry.value = null;
    this.flight.value = null;
    this.failure.value = "";
  }

  private cancelFlight(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.abort.abort();
    this.flying.value = false;
  }

  private async ask(): Promise<void> {
    if (this.asking) return;
    this.asking = true;
    let done: typeof this.wanted = null;
    while (this.wanted !== null && this.wanted !== done) {
      done = this.wanted;
      await this.askGeometry(done);
    }
    this.asking = false;
    if (done !== null && done === this.wanted) this.planFlight(done);
  }

  private async askGeometry(wanted: NonNullable<typeof this.wanted>): Promise<void> {
    const { formation_id, plan } = wanted;
    try {
      const preview = await this.api.postJson<PathPreview>("api/preview/path", {
        formation_id,
        ...plan,
        geometry_only: true,
      });
      if (this.wanted?.formation_id !== formation_id) return;
      this.geometry.value = { plan, preview, at_ms: performance.now() };
      this.failure.value = "";
    } catch (error) {
      if (this.wanted !== wanted) return;
      this.geometry.value = null;
      this.failure.value = reasonOf(error);
    }
  }

  private planFlight(wanted: NonNullable<typeof this.wanted>): void {
    if (this.geometry.peek()?.preview.ok !== true) return;
    this.timer = setTimeout(() => {
      this.timer = undefined;
      void this.fly(wanted);
    }, kQuiet_ms);
  }

  private async fly({ formation_id, plan }: NonNullable<typeof this.wanted>): Promise<void> {
    const abort = new AbortController();
    this.abort = abort;
    this.flying.value = true;
    try {
      const preview = await this.api.postJson<FlightPreview>(
        "api/preview/path",
        { formation_id, ...plan },
        abort.signal,
      );
      if (!abort.signal.aborted) this.flight.value = { plan, preview, at_ms: performance.now() };
    } catch (error) {
      if (!abort.signal.aborted) this.failure.value = reasonOf(error);
    }
    if (!abort.signal.aborted) this.flying.value = false;
  }
}

/** One at least when the plan can't be flown. */
export function problemsOf({ plan, preview }: Answer<PathPreview>): readonly PathProblem[] {
  if (preview.ok || preview.problems.length > 0) return preview.problems;
  return [{ waypoint_index: plan.waypoints.length - 1, on_leg: false, text: preview.reason }];
}

function reasonOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
