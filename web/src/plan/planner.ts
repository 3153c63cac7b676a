/** Path planning of one page: which formation, its draft, what the server says of it, and the way to the bus and back. */
import { computed, effect, signal, untracked, type ReadonlySignal } from "@preact/signals";
import type { Outcome } from "../link/commands";
import type { Waypoint } from "../link/messages";
import type { Station } from "../shell/station";
import { flownLegs, straightLegs, type FlownLeg } from "./legs";
import { PathDraft } from "./path_draft";
import { kStraightOn, leastWaypoints, type PathPlan, type Place } from "./path_plan";
import { problemsOf, Preview, type PathProblem } from "./preview";
import { readBack, type Upload } from "./upload";

const kRefresh_ms = 5000;

export class Planner {
  /** What the person chose; `formation_id` is what there is. */
  readonly chosen_id = signal<number | null>(null);
  readonly formation_id: ReadonlySignal<number | null>;
  readonly formations: ReadonlySignal<readonly { id: number; name: string }[]>;
  readonly formation_name: ReadonlySignal<string>;
  readonly draft: ReadonlySignal<PathDraft | null>;
  readonly preview: Preview;
  /** Clicks on the map add waypoints. */
  readonly drawing = signal(false);
  /** The plan that is looked over before it is sent; null: editing. */
  readonly review = signal<PathPlan | null>(null);
  readonly upload = signal<Upload>({ kind: "none" });
  /** What is wrong with the draft, as far as is known: what it lacks, else what the server says. */
  readonly problems: ReadonlySignal<readonly PathProblem[]>;
  /** As flown once that is known, as straight lines until then. */
  readonly legs: ReadonlySignal<readonly FlownLeg[]>;
  /** Why the plan can't be sent, or not yet; "" when it can. */
  readonly why_not: ReadonlySignal<string>;
  /** By formation and local origin: metres from one origin mean nothing at another. */
  private readonly drafts = new Map<string, PathDraft>();

  constructor(readonly station: Station) {
    const { store } = station;
    this.preview = new Preview(station.api);
    this.formations = computed(() =>
      [...store.formations.value.values()]
        .map(({ formation_id: id, name }) => ({ id, name: name || `Formation ${id}` }))
        .sort((a, b) => a.id - b.id),
    );
    this.formation_id = computed(() => {
      const ids = this.formations.value.map(({ id }) => id);
      return ids.find((id) => id === this.chosen_id.value) ?? ids[0] ?? null;
    });
    this.formation_name = computed(
      () => this.formations.value.find(({ id }) => id === this.formation_id.value)?.name ?? "",
    );
    this.draft = computed(() => {
      const id = this.formation_id.value;
      const origin = store.roster.value?.origin;
      const frame = origin && [origin.latitude_deg, origin.longitude_deg, origin.altitude_m].join();
      return id === null ? null : untracked(() => this.draftOf(id, `${id}/${frame ?? ""}`));
    });
    this.legs = computed(() => {
      const plan = this.draft.value?.plan.value ?? kStraightOn;
      const answer = this.preview.geometry.value;
      return answer?.plan === plan && answer.preview.ok ? flownLegs(answer.preview) : straightLegs(plan);
    });
    this.problems = computed(() => {
      const plan = this.draft.value?.plan.value ?? kStraightOn;
      const lacking = lackOf(plan);
      if (lacking !== null) return [lacking];
      const answer = this.preview.geometry.value;
      return answer === null || answer.plan.waypoints.length !== plan.waypoints.length
        ? []
        : problemsOf(answer);
    });
    this.why_not = computed(() => {
      if (this.problems.value.length > 0) return "It can't be flown like this.";
      const answer = this.preview.geometry.value;
      const checked = answer !== null && answer.plan === this.review.value;
      return checked || this.preview.failure.value !== "" ? "" : "Being checked…";
    });
  }

  get store() {
    return this.station.store;
  }

  /** Keeps the preview in step with the draft, until the returned function is called. */
  watch(): () => void {
    const stop = effect(() => {
      const [id, draft] = [this.formation_id.value, this.draft.value];
      const plan = draft?.plan.value;
      // What is flown already needs no flight ahead.
      const changed = draft?.changed.value === true;
      this.store.planned_id.value = id;
      if (id === null || plan === undefined) return;
      untracked(() => {
        if (this.review.value !== plan) this.endReview();
        if (changed && lackOf(plan) === null) this.preview.want(id, plan);
        else this.preview.stop();
      });
    });
    // The way from the leader to the first waypoint changes as the leader flies on.
    const timer = setInterval(() => {
      void this.preview.refresh();
    }, kRefresh_ms);
    return () => {
      clearInterval(timer);
      stop();
      this.preview.stop();
      this.drawing.value = false;
      this.store.planned_id.value = null;
    };
  }

  choose(formation_id: number): void {
    this.chosen_id.value = formation_id;
    this.endReview();
    this.drawing.value = false;
  }

  /** What a new waypoint gets: as the last one, the first one as the leader flies. */
  defaults(): Pick<Waypoint, "up_m" | "speed_m_s"> {
    const last = this.draft.peek()?.plan.peek().waypoints.at(-1);
    if (last !== undefined) return { up_m: last.up_m, speed_m_s: last.speed_m_s };
    const status = this.store.statuses.peek().get(this.formation_id.peek() ?? 0);
    return {
      up_m: Math.round(status?.leader_up_m ?? 1000),
      speed_m_s: Math.round((status?.leader_speed_m_s ?? 50) * 10) / 10,
    };
  }

  /** At the end of the path. */
  append(place: Place): void {
    const draft = this.draft.peek();
    if (draft === null) return;
    const { east_m, north_m } = place;
    const waypoint = { east_m, north_m, ...this.defaults(), turn_radius_m: 0 };
    draft.insert(draft.plan.peek().waypoints.length, waypoint);
  }

  toggleDrawing(): void {
    this.drawing.value = !this.drawing.peek();
  }

  removeSelected(): void {
    const draft = this.draft.peek();
    const index = draft?.selected.peek() ?? null;
    if (index !== null) draft?.remove(index);
  }

  startReview(): void {
    this.drawing.value = false;
    // What is edited after this is a step of its own.
    this.draft.peek()?.history.endGesture();
    void this.preview.refresh();
    this.review.value = this.draft.peek()?.plan.peek() ?? null;
  }

  endReview(): void {
    this.review.value = null;
    this.upload.value = { kind: "none" };
  }

  /** Sends the reviewed plan, and compares what the bus then says is flown. */
  async send(): Promise<Outcome> {
    const [formation_id, plan] = [this.formation_id.peek(), this.review.peek()];
    if (formation_id === null || plan === null)
      return { accepted: false, reason: "There is nothing to send." };
    const { paths } = this.store;
    const revision_before = paths.peek().get(formation_id)?.path_revision ?? 0;
    const outcome = await this.station.commands.request("CMD_PATH", { formation_id, ...plan });
    if (outcome.accepted) {
      this.upload.value = { kind: "reading back" };
      void readBack(paths, formation_id, plan, revision_before).then((upload) => {
        if (this.review.peek() === plan) this.upload.value = upload;
      });
    }
    return outcome;
  }

  private draftOf(id: number, key: string): PathDraft {
    const known = this.drafts.get(key);
    if (known !== undefined) return known;
    let last = kStraightOn;
    const flown = computed(() => {
      const path = this.store.paths.value.get(id);
      if (path !== undefined) last = { closed: path.closed, waypoints: path.waypoints };
      // While nothing is known, after a new connection or between two flights, it is what was known last.
      return last;
    });
    const draft = new PathDraft(flown);
    this.drafts.set(key, draft);
    return draft;
  }
}

/** A path needs two points, a loop three; none at all is straight on. */
function lackOf({ closed, waypoints }: PathPlan): PathProblem | null {
  const least = leastWaypoints(closed);
  if (waypoints.length === 0 || waypoints.length >= least) return null;
  return {
    waypoint_index: waypoints.length - 1,
    on_leg: false,
    text: `A ${closed ? "loop" : "path"} needs ${least} waypoints: add another.`,
  };
}

const planners = new WeakMap<Station, Planner>();

/** Drafts outlive their panel: closing the drawer loses nothing. */
export function plannerOf(station: Station): Planner {
  const known = planners.get(station);
  if (known !== undefined) return known;
  const planner = new Planner(station);
  planners.set(station, planner);
  return planner;
}
