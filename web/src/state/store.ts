/** What the page knows: small things as signals, bulk telemetry in `fleet`. Views only read; `takeText` and `takeFrame` write. */
import { batch, computed, signal } from "@preact/signals";
import type { ConnectionState } from "../link/connection";
import type { Frame } from "../link/frames";
import type {
  Ack,
  AlarmList,
  BusEvent,
  Formation,
  FormationStatus,
  Heartbeat,
  Hello,
  Path,
  RecordingStatus,
  Roster,
  ServerMessage,
} from "../link/messages";
import type { PlaybackMessage } from "../link/recording_messages";
import type { ControlMessage } from "../control/people";
import { Fleet } from "./fleet";
import { replay } from "./replay";

const kMostEvents = 1000;
/** The bridge sends motion at 5 Hz or more while the bus lives. */
const kBusSilence_ms = 2500;

export class Store {
  readonly fleet = new Fleet();
  readonly connection = signal<ConnectionState>({ kind: "connecting" });
  readonly hello = signal<Hello | null>(null);
  /** When the bridge said hello (performance.now). */
  hello_ms = 0;
  readonly roster = signal<Roster | null>(null);
  readonly formations = signal<ReadonlyMap<number, Formation>>(new Map());
  readonly paths = signal<ReadonlyMap<number, Path>>(new Map());
  /** Published by `beat`: each formation tells five times a second, and panels would be drawn as often for each of them. */
  readonly statuses = signal<ReadonlyMap<number, FormationStatus>>(new Map());
  private readonly newest_statuses = new Map<number, FormationStatus>();
  readonly heartbeats = signal<ReadonlyMap<string, Heartbeat>>(new Map());
  /** Null: the bridge has heard none. */
  readonly alarms = signal<AlarmList | null>(null);
  /** Null: the bridge has heard none of late. */
  readonly recording = signal<RecordingStatus | null>(null);
  /** When it came (performance.now). */
  recording_ms = 0;
  readonly silent_nodes = signal<readonly string[]>([]);
  /** Newest first. */
  readonly events = signal<readonly BusEvent[]>([]);
  /** UAVs that are selected, wherever that was done, in the order in which they were. */
  readonly selection = signal<ReadonlySet<number>>(new Set());
  /** The one that was selected last; null without any. */
  readonly selected_id = computed(() => [...this.selection.value].at(-1) ?? null);
  /** The formation whose path somebody plans: the planner draws its waypoints. */
  readonly planned_id = signal<number | null>(null);
  /** What is played of a recording; null: nothing. */
  readonly playback = signal<PlaybackMessage | null>(null);
  /** When `playback` came (performance.now). */
  playback_ms = 0;
  /** The time (performance.now), a few times a second: what goes with time or shows `fleet` reads it, and is drawn again. */
  readonly now_ms = signal(performance.now());

  /** What has come of the picture that follows a hello or a reset, to be shown at once; null: none is on its way. */
  private picture: (() => void)[] | null = null;
  /** It follows a reset: what was shown before counts no more. */
  private jumped = false;

  private readonly callsigns = computed(
    () => new Map(this.roster.value?.vehicles.map((vehicle) => [vehicle.id, vehicle.callsign])),
  );

  constructor(
    private readonly onAck: (ack: Ack) => void,
    private readonly onControl: (control: ControlMessage) => void = () => undefined,
  ) {}

  takeText(text: string): void {
    const message = JSON.parse(text) as ServerMessage;
    if (message.type === "reset") {
      this.picture = [];
      this.jumped = true;
      return;
    }
    if (message.type === "hello" && !this.jumped) this.picture = [];
    if (this.picture === null) {
      this.take(message);
      return;
    }
    this.picture.push(() => {
      this.take(message);
    });
    // After a jump it is shown when the time that it belongs to is known, too.
    if (
      message.type === "playback" ||
      message.type === "ack" ||
      (message.type === "complete" && !this.jumped)
    )
      this.showPicture();
  }

  private take(message: ServerMessage): void {
    switch (message.type) {
      case "hello":
        this.startOver(message);
        break;
      case "roster":
        this.takeRoster(message);
        break;
      case "formation":
        this.formations.value = withEntry(this.formations.value, message.formation_id, message);
        break;
      case "formation_removed":
        this.formations.value = withoutEntry(this.formations.value, message.formation_id);
        this.paths.value = withoutEntry(this.paths.value, message.formation_id);
        this.statuses.value = withoutEntry(this.statuses.value, message.formation_id);
        this.newest_statuses.delete(message.formation_id);
        break;
      case "path":
        this.paths.value = withEntry(this.paths.value, message.formation_id, message);
        break;
      case "status":
        this.newest_statuses.set(message.formation_id, message);
        break;
      case "statuses":
        for (const status of message.statuses) this.newest_statuses.set(status.formation_id, status);
        break;
      case "event":
        this.takeEvent(message);
        break;
      case "alarms":
        this.alarms.value = message;
        break;
      case "recording":
        this.recording_ms = performance.now();
        this.recording.value = message;
        break;
      case "heartbeat":
        this.heartbeats.value = withEntry(this.heartbeats.value, message.heartbeat_node, message);
        break;
      case "bus":
        this.silent_nodes.value = message.nodes_silent;
        break;
      case "control":
        this.onControl(message);
        break;
      case "playback":
        this.takePlayback(message);
        break;
      case "reset":
      case "complete":
        break;
      case "ack":
        this.onAck(message);
        break;
    }
  }

  /** A few times a second: what goes with time, or came too often to be shown at once, is drawn again. */
  beat(now_ms: number): void {
    batch(() => {
      this.publishStatuses();
      this.now_ms.value = now_ms;
    });
  }

  private publishStatuses(): void {
    if (this.newest_statuses.size === 0) return;
    this.statuses.value = new Map([...this.statuses.value, ...this.newest_statuses]);
    this.newest_statuses.clear();
  }

  /** Selects these UAVs and no others. */
  select(ids: Iterable<number>): void {
    this.selection.value = new Set(ids);
  }

  /** Adds a UAV to those that are selected, or takes it out. */
  toggleSelected(id: number): void {
    const ids = new Set(this.selection.value);
    if (!ids.delete(id)) ids.add(id);
    this.selection.value = ids;
  }

  takeFrame(frame: Frame, now_ms: number): void {
    const take = () => {
      this.fleet.take(frame, now_ms);
    };
    if (this.picture === null) take();
    else this.picture.push(take);
  }

  /** Time on the bus now [us], carried on from the newest frame; null before the first. */
  utimeAt(now_ms: number): number | null {
    const motion = this.fleet.motion;
    return motion === null
      ? null
      : motion.utime + (this.isStale(now_ms) ? 0 : this.fleet.sinceMotion_ms(now_ms) * 1000);
  }

  /** What is on the screen is old: the bridge or the bus is gone. */
  isStale(now_ms: number): boolean {
    return this.connection.value.kind !== "open" || this.busSilence_s(now_ms) !== null;
  }

  /** For how long the bus has been silent; null while it is not, or before it was heard. */
  busSilence_s(now_ms: number): number | null {
    const motion = this.fleet.motion;
    if (motion === null) return null;
    const silence_ms = this.fleet.sinceMotion_ms(now_ms);
    // In fast motion there is more of the flight between two frames.
    return silence_ms > kBusSilence_ms * Math.max(1, this.fleet.pace.speed) ? silence_ms / 1000 : null;
  }

  callsign(id: number): string {
    return this.callsigns.value.get(id) ?? `UAV ${id}`;
  }

  private showPicture(): void {
    const [picture, jumped] = [this.picture ?? [], this.jumped];
    this.picture = null;
    this.jumped = false;
    batch(() => {
      if (jumped) {
        this.events.value = [];
        this.fleet.clear();
      }
      for (const take of picture) take();
      this.publishStatuses();
    });
  }

  private takePlayback(playback: PlaybackMessage): void {
    const now_ms = performance.now();
    this.fleet.pace.set(playback.state === "playing" ? playback.speed * playback.direction : 0, now_ms);
    this.playback_ms = now_ms;
    this.playback.value = playback;
  }

  /** A bridge says hello first, then everything it knows: what it no longer knows is gone. What happened has happened. */
  private startOver(hello: Hello): void {
    // With each jump in a recording the same bridge says hello again: whoever looks at it has nothing to do.
    if (!sameBridge(this.hello.value, hello)) this.hello.value = hello;
    this.hello_ms = performance.now();
    replay.value = hello.replay ?? null;
    this.formations.value = new Map();
    this.paths.value = new Map();
    this.statuses.value = new Map();
    this.newest_statuses.clear();
    this.heartbeats.value = new Map();
    this.alarms.value = null;
    this.recording.value = null;
    this.silent_nodes.value = [];
  }

  private takeRoster(roster: Roster): void {
    const before = this.roster.value;
    if (before !== null && before.start_utime !== roster.start_utime) this.fleet.clear();
    this.roster.value = roster;
    const known = new Set(roster.vehicles.map((vehicle) => vehicle.id));
    const kept = [...this.selection.value].filter((id) => known.has(id));
    if (kept.length !== this.selection.value.size) this.select(kept);
  }

  private takeEvent(event: BusEvent): void {
    const known = this.events.value.some(
      (other) =>
        other.event_node === event.event_node &&
        other.event_sequence === event.event_sequence &&
        other.utime === event.utime,
    );
    if (known) return;
    this.events.value = [event, ...this.events.value].sort((a, b) => b.utime - a.utime).slice(0, kMostEvents);
  }
}

function sameBridge(before: Hello | null, hello: Hello): boolean {
  if (before === null || hello.replay?.kind !== "log") return false;
  return JSON.stringify({ ...before, utime: 0 }) === JSON.stringify({ ...hello, utime: 0 });
}

function withEntry<K, V>(map: ReadonlyMap<K, V>, key: K, value: V): ReadonlyMap<K, V> {
  return new Map(map).set(key, value);
}

function withoutEntry<K, V>(map: ReadonlyMap<K, V>, key: K): ReadonlyMap<K, V> {
  const copy = new Map(map);
  copy.delete(key);
  return copy;
}
