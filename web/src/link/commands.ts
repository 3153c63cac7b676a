import type { Ack, CommandBodies, CommandChannel, ControlBody } from "./messages";
import type { PlaybackBody } from "./recording_messages";

export interface Outcome {
  accepted: boolean;
  /** Why not, for people; "" when accepted without a remark. */
  reason: string;
}

/** The bridge answers within 2 s, also when nobody on the bus does. */
const kTimeout_ms = 4000;

/** Sends commands and matches the answers with them. Nothing is sent twice: the operator decides. */
export class Commands {
  private readonly pending = new Map<string, (outcome: Outcome) => void>();
  private count = 0;

  /** `send` is false when there is no connection. */
  constructor(private readonly send: (text: string) => boolean) {}

  request<C extends CommandChannel>(channel: C, body: CommandBodies[C]): Promise<Outcome> {
    return this.sendWithId({ type: "command", channel, body });
  }

  /** About who may command: to the bridge itself. */
  control(body: ControlBody): Promise<Outcome> {
    return this.sendWithId({ type: "control", ...body });
  }

  /** About what is played of a recording: to the bridge itself. */
  playback(body: PlaybackBody): Promise<Outcome> {
    return this.sendWithId({ type: "playback", ...body });
  }

  private sendWithId(message: object): Promise<Outcome> {
    this.count += 1;
    const id = `c${this.count}`;
    if (!this.send(JSON.stringify({ ...message, id }))) {
      return Promise.resolve({ accepted: false, reason: "Not sent: no connection to web-bridge." });
    }
    return new Promise((resolve) => {
      const timer = setTimeout(() => {
        this.settle(id, { accepted: false, reason: "web-bridge did not answer." });
      }, kTimeout_ms);
      this.pending.set(id, (outcome) => {
        clearTimeout(timer);
        resolve(outcome);
      });
    });
  }

  acknowledged(ack: Ack): void {
    if (ack.id !== null) this.settle(ack.id, { accepted: ack.accepted, reason: ack.reason });
  }

  /** The connection is gone, and the answers with it. */
  connectionLost(): void {
    for (const id of [...this.pending.keys()]) {
      this.settle(id, {
        accepted: false,
        reason: "Connection lost before the answer came: look at the telemetry.",
      });
    }
  }

  private settle(id: string, outcome: Outcome): void {
    const resolve = this.pending.get(id);
    this.pending.delete(id);
    resolve?.(outcome);
  }
}
