/** What a person does with the recording that is open: the bridge plays it, and says where it is. */
import { computed, effect, signal, untracked } from "@preact/signals";
import type { Api } from "../link/api";
import type { Commands, Outcome } from "../link/commands";
import type { PlaybackBody, PlaybackMessage, RecordingInfo } from "../link/recording_messages";
import { replay } from "../state/replay";
import type { Store } from "../state/store";
import { loopProblem, nextSpeed, timeAt, type Span } from "./playing";

const kAskAgain_ms = 300;
/** Well below the silence after which a connection is given up. */
const kKeepAlive_ms = 4000;
/** A recording that is being written grows by the second: its outline is fetched again after so much more [s]. */
const kGrown_s = 10;

export class Player {
  /** The recording that is open; "" without any. */
  readonly name = computed(() => (replay.value?.kind === "log" ? replay.value.name : ""));
  /** What is in it; null until that is known. */
  readonly info = signal<RecordingInfo | null>(null);
  /** Why it can't be had; "". */
  readonly problem = signal("");
  /** Why the last action was refused; "". */
  readonly refusal = signal("");
  /** Where the person drags to, until the bridge has jumped there. */
  readonly wanted_s = signal<number | null>(null);
  /** One end of a loop whose other end is still to be set. */
  readonly loop_a_s = signal<number | null>(null);
  private seeking = false;
  /** What was asked for and is not told yet: times real time, negative backwards. Nobody else changes it. */
  private velocity_asked: number | null = null;
  /** Where a lost connection has left us. */
  private left: PlaybackMessage | null = null;
  /** The last that the connection said which was lost. */
  private lost_with: PlaybackMessage | null = null;

  constructor(
    private readonly store: Store,
    private readonly commands: Commands,
    private readonly api: Api,
  ) {
    // The outline: when there is a name, with each new connection, and when the recording has grown.
    const connections = signal(0);
    effect(() => {
      if (this.store.connection.value.kind === "open") connections.value = connections.peek() + 1;
    });
    const due = computed(() => {
      const duration_s = this.store.playback.value?.duration_s ?? 0;
      return `${this.name.value}/${connections.value}/${Math.floor(duration_s / kGrown_s)}`;
    });
    effect(() => {
      void due.value;
      const name = untracked(() => this.name.value);
      const abort = new AbortController();
      if (name !== "") void this.fetchInfo(name, abort.signal);
      return () => {
        abort.abort();
      };
    });
    effect(() => {
      this.comeBack();
    });
    effect(() => this.keepAlive());
    effect(() => {
      const told = this.store.playback.value;
      const lost = this.store.connection.value.kind !== "open";
      if (lost || (told !== null && told.direction * told.speed === this.velocity_asked))
        this.velocity_asked = null;
    });
  }

  /** While nothing plays nothing comes, and a link that is dead would not be noticed: so something is asked that changes nothing. */
  private keepAlive(): (() => void) | undefined {
    const playback = this.store.playback.value;
    const still = playback?.state === "paused" || playback?.state === "ended";
    if (!still || this.store.connection.value.kind !== "open") return undefined;
    const timer = setInterval(
      () => void this.commands.playback({ action: "speed", speed: this.velocity() }),
      kKeepAlive_ms,
    );
    return () => {
      clearInterval(timer);
    };
  }

  /** A new connection has a player of its own, at the beginning: it is taken where the last one was. */
  private comeBack(): void {
    const playback = this.store.playback.value;
    if (playback === null) return;
    if (this.store.connection.value.kind !== "open") {
      const under_way = ["paused", "playing", "ended"].includes(playback.state);
      this.lost_with = playback;
      if (under_way) this.left ??= { ...playback, t_s: untracked(() => this.at_s(performance.now())) };
      return;
    }
    // Its first word need not be "opening": newer words replace older ones on the way.
    const left = this.left;
    if (left === null || playback === this.lost_with || playback.state !== "paused") return;
    this.left = null;
    this.seek(left.t_s);
    void this.ask({ action: "speed", speed: left.direction * left.speed });
    if (left.loop !== null) void this.ask({ action: "loop", loop: left.loop });
    if (left.state === "playing") void this.ask({ action: "play" });
  }

  /** Length of the recording [s]; 0 until it is known. */
  duration_s(): number {
    return this.store.playback.value?.duration_s || (this.info.value?.duration_s ?? 0);
  }

  /** The first event of the recording; null until it is known. */
  start_utime(): number | null {
    return this.store.playback.value?.start_utime || (this.info.value?.start_utime ?? null);
  }

  /** What is played now [s]: what the bridge said last, carried on. */
  at_s(now_ms: number): number {
    const playback = this.store.playback.value;
    if (this.wanted_s.value !== null) return this.wanted_s.value;
    if (this.left !== null) return this.left.t_s;
    return playback === null ? 0 : timeAt(playback, Math.max(0, now_ms - this.store.playback_ms) / 1000);
  }

  /** What it shows is where the person wants to be, or was: the bridge has not jumped there yet. */
  busy(): boolean {
    return this.wanted_s.value !== null || this.left !== null;
  }

  playing(): boolean {
    return this.store.playback.value?.state === "playing";
  }

  /** Plays forwards (1) or backwards (-1), or pauses when it does just that. */
  async toggle(direction: 1 | -1): Promise<void> {
    const playback = this.store.playback.value;
    if (playback === null) return;
    if (playback.state === "playing" && Math.sign(this.velocity()) === direction) {
      await this.ask({ action: "pause" });
      return;
    }
    if (Math.sign(this.velocity()) !== direction) await this.setVelocity(-this.velocity());
    await this.ask({ action: "play" });
  }

  async step(steps: number): Promise<void> {
    await this.ask({ action: "step", steps });
  }

  /** Jumps. While a jump is under way only the last that was wanted waits. */
  seek(t_s: number): void {
    this.wanted_s.value = Math.min(Math.max(t_s, 0), this.duration_s());
    if (!this.seeking) void this.followWanted();
  }

  setSpeed(speed: number): Promise<void> {
    return this.setVelocity(Math.sign(this.velocity()) * speed);
  }

  changeSpeed(steps: 1 | -1): Promise<void> {
    return this.setSpeed(nextSpeed(Math.abs(this.velocity()), steps));
  }

  /** Times real time, negative backwards: what the bridge has been asked for, though it may not have said so yet. */
  private velocity(): number {
    const { direction, speed } = this.store.playback.value ?? { direction: 1, speed: 1 };
    return this.velocity_asked ?? direction * speed;
  }

  private async setVelocity(velocity: number): Promise<void> {
    this.velocity_asked = velocity;
    const accepted = await this.ask({ action: "speed", speed: velocity });
    if (!accepted && this.velocity_asked === velocity) this.velocity_asked = null;
  }

  /** Sets an end of the loop to the time that is played. */
  setLoopEnd(end: "a" | "b"): void {
    this.refusal.value = "";
    const t_s = this.at_s(performance.now());
    const loop = this.store.playback.value?.loop ?? null;
    const a_s = end === "a" ? t_s : (loop?.[0] ?? this.loop_a_s.value ?? 0);
    const b_s = end === "b" ? t_s : (loop?.[1] ?? null);
    if (b_s === null || (end === "a" && loopProblem(a_s, b_s) !== "")) {
      // A loop that would begin behind its end is begun anew.
      this.loop_a_s.value = a_s;
      if (loop !== null) void this.ask({ action: "loop", loop: null });
      return;
    }
    const problem = loopProblem(a_s, b_s);
    this.refusal.value = problem;
    if (problem === "") void this.loop({ from_s: a_s, to_s: b_s });
  }

  async loop(span: Span | null): Promise<void> {
    this.loop_a_s.value = null;
    await this.ask({ action: "loop", loop: span === null ? null : [span.from_s, span.to_s] });
  }

  private async followWanted(): Promise<void> {
    this.seeking = true;
    let t_s = this.wanted_s.value;
    while (t_s !== null) {
      await this.ask({ action: "seek", t_s });
      const newest_s = this.wanted_s.value;
      if (newest_s === t_s) this.wanted_s.value = null;
      t_s = newest_s === t_s ? null : newest_s;
    }
    this.seeking = false;
  }

  private async ask(body: PlaybackBody): Promise<boolean> {
    const { accepted, reason }: Outcome = await this.commands.playback(body);
    this.refusal.value = accepted ? "" : reason;
    return accepted;
  }

  private async fetchInfo(name: string, abort: AbortSignal): Promise<void> {
    const path = `api/recordings/${encodeURIComponent(name)}`;
    try {
      let answer = await this.api.getJson<RecordingInfo | { progress: number }>(path, abort);
      while ("progress" in answer) {
        await new Promise((resolve) => setTimeout(resolve, kAskAgain_ms));
        answer = await this.api.getJson<RecordingInfo | { progress: number }>(path, abort);
      }
      this.problem.value = "";
      this.info.value = answer;
    } catch (error) {
      if (!abort.aborted) this.problem.value = error instanceof Error ? error.message : String(error);
    }
  }
}
