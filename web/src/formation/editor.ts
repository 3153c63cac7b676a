/** The formation editor behind its panel: which formation is edited, who is proposed for which slot, and what Apply would risk. */
import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";
import type { Outcome } from "../link/commands";
import type { Station } from "../shell/station";
import { assignInWorker, type Points } from "./assignment";
import { conflictsOf, problemsOf, type Conflict } from "./checks";
import { bodyOf, draftOf, newDraft, withOrder, type Draft } from "./draft";
import {
  leaderOf,
  leaderOver,
  placingOf,
  rigid,
  seenFrom,
  type Flying,
  type Leader,
  type Placing,
} from "./placement";
import { Preview } from "./preview";
import { EditSession } from "./session";
import type { Offset } from "./shapes";

/** Where the draft's slots lie on the map at one moment. */
export interface Ground {
  leader: Leader;
  place: Placing;
}

export class FormationEditor {
  readonly sessions = signal<ReadonlyMap<number, EditSession>>(new Map());
  readonly chosen_id = signal<number | null>(null);
  /** Whom the person chose: back when it is flown again. */
  private wished_id: number | null = null;
  readonly session: ReadonlySignal<EditSession | null>;
  readonly conflicts: ReadonlySignal<readonly Conflict[]>;
  /** Whose slots those are. */
  readonly conflicting: ReadonlySignal<ReadonlySet<number>>;
  readonly problems: ReadonlySignal<readonly string[]>;
  readonly preview: Preview;
  /** The panel is open: drafts are drawn on the map and flown ahead. */
  readonly open = signal(false);
  /** Places are being worked out. */
  readonly proposing = signal(false);
  /** Why no places could be proposed. */
  readonly proposal_problem = signal("");
  /** The draft that was commanded and accepted last. */
  readonly accepted = signal<Draft | null>(null);
  /** The time of the preview that is drawn on the map [s]; 0: only its tracks. */
  readonly looked_at_s = signal(0);
  private readonly flown_places = computed(
    () => new Map(this.session.value?.flown.value?.slots.map((slot) => [slot.vehicle_id, slot])),
  );
  private proposal = new AbortController();

  constructor(readonly station: Station) {
    const { store } = station;
    this.preview = new Preview(station.api);
    this.session = computed(() => this.sessions.value.get(this.chosen_id.value ?? -1) ?? null);
    this.conflicts = computed(() => {
      const draft = this.session.value?.draft.value;
      return draft === undefined ? [] : conflictsOf(draft.slots, draft.limits);
    });
    this.conflicting = computed(() => new Set(this.conflicts.value.flatMap(({ ids }) => ids)));
    const in_fleet = computed(() => new Set(store.roster.value?.vehicles.map(({ id }) => id)));
    this.problems = computed(() => {
      const draft = this.session.value?.draft.value;
      if (draft === undefined) return [];
      return problemsOf(
        draft,
        store.formations.value,
        (id) => store.callsign(id),
        (id) => in_fleet.value.has(id),
      );
    });
    effect(() => {
      this.stayChosen();
    });
    effect(() => {
      this.flyAhead();
    });
  }

  /** Opens a formation that is flown; its draft is as it was left. */
  choose(formation_id: number): void {
    this.wished_id = formation_id;
    this.show(formation_id);
  }

  private show(formation_id: number): void {
    const { formations } = this.station.store;
    const formation = formations.peek().get(formation_id);
    if (!this.sessions.peek().has(formation_id) && formation !== undefined) {
      this.keep(formation_id, draftOf(formation));
    }
    this.chosen_id.value = formation_id;
  }

  /** Begins a new formation of these UAVs. */
  create(vehicle_ids: readonly number[]): void {
    const taken = [...this.station.store.formations.peek().keys(), ...this.sessions.peek().keys()];
    const id = Math.max(0, ...taken) + 1;
    this.keep(id, newDraft(id, vehicle_ids));
    this.wished_id = id;
    this.chosen_id.value = id;
    void this.propose("propose places");
  }

  /** Forgets the draft: what is flown is shown again, and one that is not flown is gone. */
  discard(): void {
    const session = this.session.peek();
    const id = this.chosen_id.peek();
    if (session === null || id === null) return;
    if (session.flown.peek() !== null) {
      session.takeFlown();
      return;
    }
    session.end();
    const sessions = new Map(this.sessions.peek());
    sessions.delete(id);
    this.chosen_id.value = null;
    this.sessions.value = sessions;
  }

  change(draft: Draft, label: string, gesture: string | null = null): void {
    this.session.peek()?.change(draft, label, gesture);
  }

  /** Changes where slots lie: who flies where is proposed anew, unless that was settled by hand. Undone as one step. */
  reshape(draft: Draft, label: string): void {
    this.change(draft, label, label);
    if (draft.by_hand) this.session.peek()?.history.endGesture();
    else void this.propose(label);
  }

  /** Who should fly to which slot, so that no ways cross. */
  async propose(label: string): Promise<void> {
    this.proposal.abort();
    const abort = new AbortController();
    this.proposal = abort;
    const session = this.session.peek();
    const draft = session?.draft.peek();
    const ground = this.ground(performance.now());
    if (session === null || draft === undefined) return;
    if (ground === null) {
      session.history.endGesture();
      return;
    }
    // Those that were never heard keep their slots.
    const heard = draft.slots.flatMap(({ vehicle_id }, slot) => {
      const at = this.flying(vehicle_id, performance.now());
      return at === null ? [] : [{ vehicle_id, slot, at }];
    });
    const from: Points = Float64Array.from(heard.flatMap(({ at }) => [at.east_m, at.north_m, at.up_m]));
    const to: Points = Float64Array.from(
      heard.flatMap(({ slot }) => {
        const { east_m, north_m, up_m } = ground.place(draft.slots[slot]);
        return [east_m, north_m, up_m];
      }),
    );
    this.proposing.value = true;
    this.proposal_problem.value = "";
    try {
      const places = await assignInWorker(from, to, abort.signal);
      const order = draft.slots.map(({ vehicle_id }) => vehicle_id);
      heard.forEach(({ vehicle_id }, i) => {
        const slot = heard[places[i] ?? i]?.slot;
        if (slot !== undefined) order[slot] = vehicle_id;
      });
      // Edited meanwhile: the proposal was for something else.
      if (session.draft.peek() === draft) session.change(withOrder(draft, order, false), label, label);
    } catch (error) {
      if (abort.signal.aborted) return;
      this.proposal_problem.value = `No places could be proposed: ${String(error)}`;
    } finally {
      session.history.endGesture();
      if (this.proposal === abort) this.proposing.value = false;
    }
  }

  async apply(): Promise<Outcome> {
    const session = this.session.peek();
    if (session === null) return { accepted: false, reason: "There is no formation to apply." };
    const draft = session.draft.peek();
    const formation = bodyOf(draft, session.flown.peek()?.hold ?? false);
    const outcome = await this.station.commands.request("CMD_FORMATION", { action: "apply", formation });
    if (outcome.accepted) this.accepted.value = draft;
    return outcome;
  }

  /** Where the draft's slots would be now; null: nobody knows where its UAVs are. */
  ground(now_ms: number): Ground | null {
    const { store } = this.station;
    const draft = this.session.peek()?.draft.peek();
    if (draft === undefined) return null;
    const status = store.statuses.peek().get(draft.formation_id);
    if (status !== undefined) {
      const leader = leaderOf(status, store.fleet.since_s(status.utime, now_ms));
      const path = store.paths.peek().get(draft.formation_id);
      return { leader, place: placingOf(draft.control, leader, status, path) };
    }
    const members = draft.slots.flatMap((offset) => {
      const flying = this.flying(offset.vehicle_id, now_ms);
      return flying === null ? [] : [{ offset, flying }];
    });
    const leader = leaderOver(members);
    // A leader that is not there yet flies straight on.
    return leader === null ? null : { leader, place: rigid(leader) };
  }

  /** How a UAV flies now; null: it was never heard. */
  flying(id: number, now_ms: number): Flying | null {
    const { fleet } = this.station.store;
    const row = fleet.motionRow(id);
    if (row < 0 || fleet.motion === null) return null;
    return {
      ...fleet.placeAt(row, now_ms),
      speed_m_s: fleet.motion.speed_m_s[row],
      course_rad: fleet.motion.course_rad[row],
    };
  }

  /** Where a UAV is now, seen from the leader: its slot as it is flown, less its error. */
  seen(id: number, ground: Ground, now_ms: number): Offset | null {
    const { fleet } = this.station.store;
    const flown = this.flown_places.value.get(id);
    const row = fleet.statusRow(id);
    if (flown !== undefined && row >= 0 && fleet.status !== null) {
      return {
        forward_m: flown.forward_m - fleet.status.forward_error_m[row],
        left_m: flown.left_m - fleet.status.left_error_m[row],
        up_m: flown.up_m - fleet.status.up_error_m[row],
      };
    }
    const flying = this.flying(id, now_ms);
    return flying === null ? null : seenFrom(ground.leader, flying);
  }

  private keep(formation_id: number, draft: Draft): void {
    const flown = computed(() => this.station.store.formations.value.get(formation_id) ?? null);
    const sessions = new Map(this.sessions.peek());
    this.sessions.value = sessions.set(formation_id, new EditSession(draft, flown));
  }

  /** There is always one that is edited, as long as any is flown. */
  private stayChosen(): void {
    const { formations } = this.station.store;
    const known = formations.value;
    const sessions = this.sessions.value;
    for (const [id, session] of sessions) {
      // Gone, and nobody had changed anything about it.
      if (known.has(id) || !session.removed || session.history.undo_label.peek() !== null) continue;
      session.end();
      const others = new Map(sessions);
      others.delete(id);
      this.sessions.value = others;
      return;
    }
    const chosen = this.chosen_id.value;
    const wished = this.wished_id;
    const wanted = wished !== null && known.has(wished) ? wished : Math.min(...known.keys());
    const in_place = chosen !== null && sessions.has(chosen);
    // One that took the place of the wished one gives it back, unless somebody has begun to change it.
    const stands_in = chosen !== wished && this.session.peek()?.changed.peek() !== true;
    if ((!in_place || (wanted === wished && stands_in)) && Number.isFinite(wanted)) this.show(wanted);
  }

  private flyAhead(): void {
    const session = this.session.value;
    const wanted = this.open.value && session?.changed.value === true && this.problems.value.length === 0;
    if (wanted && !this.proposing.value) this.preview.want(session.draft.value);
    else this.preview.clear();
  }
}

const editors = new WeakMap<Station, FormationEditor>();

/** One editor a station: drafts outlive the panel. */
export function editorOf(station: Station): FormationEditor {
  const known = editors.get(station);
  if (known !== undefined) return known;
  const editor = new FormationEditor(station);
  editors.set(station, editor);
  return editor;
}
