/** A draft flown ahead by the bridge, from the state of now and by the code that will fly it. */
import { signal, type ReadonlySignal } from "@preact/signals";
import type { Api } from "../link/api";
import { bodyOf, type Draft } from "./draft";

/** Answer to POST /api/preview/formation (cpp/bridge/README.md). When it is not `ok`, nothing else is told. */
export type FormationPreview = { ok: false; reason: string } | FlownAhead;

export interface FlownAhead {
  ok: true;
  duration_s: number;
  /** False: it was ended before all had settled. */
  complete: boolean;
  /** Null: nobody else is there. */
  least: Approach | null;
  /** The nearest pairs, worst first. */
  nearest: Approach[];
  /** Null: not within the time that was flown. */
  settle_s: number | null;
  /** Who was kept out of its slot by its envelope. */
  limits: LimitReached[];
  tracks: Track[];
}

/** How near two UAVs come to one another's cylinder. */
export interface Approach {
  horizontal_m: number;
  vertical_m: number;
  t_s: number;
  ids: [number, number];
  inside_cylinder: boolean;
}

export interface LimitReached {
  vehicle_id: number;
  limit: string;
  t_s: number;
  seconds: number;
}

export interface Track {
  id: number;
  /** [t_s, east_m, north_m, up_m]. */
  points: [number, number, number, number][];
}

export type PreviewState =
  | { kind: "none" }
  | { kind: "waiting" }
  | { kind: "running"; since_ms: number }
  | { kind: "done"; result: FormationPreview; at_ms: number }
  | { kind: "failed"; reason: string };

/** Edits have settled after this long. */
const kSettled_ms = 500;
/** The fleet flies on: what was flown ahead counts for so long, and is flown anew; not most of the time, though. */
export const kOld_ms = 15_000;
const kLeastRest = 10;

export class Preview {
  private readonly now = signal<PreviewState>({ kind: "none" });
  readonly state: ReadonlySignal<PreviewState> = this.now;
  private wanted: Draft | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private request = new AbortController();

  constructor(private readonly api: Pick<Api, "postJson">) {}

  /** Flies this draft as soon as no other one is wanted for a moment; what was flown of an earlier one is gone. */
  want(draft: Draft, delay_ms = kSettled_ms): void {
    if (draft === this.wanted) return;
    this.clear();
    this.wanted = draft;
    this.now.value = { kind: "waiting" };
    this.timer = setTimeout(() => {
      void this.fly(draft);
    }, delay_ms);
  }

  /** Flies the same draft from the state of now. */
  again(): void {
    const draft = this.wanted;
    this.wanted = null;
    if (draft !== null) this.want(draft, 0);
  }

  /** Does not fly it anew: somebody has made up their mind about what is in sight. */
  keep(): void {
    clearTimeout(this.timer);
  }

  clear(): void {
    clearTimeout(this.timer);
    this.request.abort();
    this.wanted = null;
    this.now.value = { kind: "none" };
  }

  private async fly(draft: Draft): Promise<void> {
    const request = new AbortController();
    this.request = request;
    const since_ms = performance.now();
    // While the same draft is flown anew, what was found before stays in sight.
    if (this.now.peek().kind !== "done") this.now.value = { kind: "running", since_ms };
    try {
      const body = { formation: bodyOf(draft) };
      const result = await this.api.postJson<FormationPreview>("api/preview/formation", body, request.signal);
      if (request.signal.aborted) return;
      const at_ms = performance.now();
      this.now.value = { kind: "done", result, at_ms };
      const rest_ms = Math.max(kOld_ms, kLeastRest * (at_ms - since_ms));
      this.timer = setTimeout(() => {
        void this.fly(draft);
      }, rest_ms);
    } catch (error) {
      if (request.signal.aborted) return;
      this.now.value = { kind: "failed", reason: error instanceof Error ? error.message : String(error) };
    }
  }
}
