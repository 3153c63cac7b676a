/** The live link to web-bridge: a WebSocket that comes back by itself and always tells how it is. */

export type ConnectionState =
  | { kind: "connecting" }
  | { kind: "open" }
  /** Lost, or never found; the next attempt is due at `retry_at_ms` (performance.now). */
  | { kind: "waiting"; attempt: number; retry_at_ms: number }
  /** The bridge lets nobody in without a token: no more attempts until there is one. */
  | { kind: "signed out" };

/** What is used of a WebSocket. */
export interface Socket {
  binaryType: string;
  onopen: ((event: Event) => void) | null;
  onmessage: ((event: MessageEvent<unknown>) => void) | null;
  onclose: ((event: CloseEvent) => void) | null;
  send(text: string): void;
  close(): void;
}

export interface ConnectionHandlers {
  onState(state: ConnectionState): void;
  onText(text: string): void;
  onBinary(buffer: ArrayBuffer): void;
}

const kFirstDelay_ms = 500;
const kLongestDelay_ms = 5000;
/**
 * The bridge's own heartbeat comes every second: silence for this long is a dead link that TCP hasn't noticed, or an attempt
 * that nobody answers (browsers themselves wait for minutes).
 */
const kSilence_ms = 10_000;

export class Connection {
  private socket: Socket | null = null;
  private failures = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly connect: () => Socket,
    private readonly handlers: ConnectionHandlers,
  ) {}

  start(): void {
    clearTimeout(this.timer);
    this.handlers.onState({ kind: "connecting" });
    const socket = this.connect();
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    this.expectData(socket);
    socket.onopen = () => {
      this.failures = 0;
      this.handlers.onState({ kind: "open" });
      this.expectData(socket);
    };
    socket.onmessage = (event) => {
      this.expectData(socket);
      if (typeof event.data === "string") this.handlers.onText(event.data);
      else if (event.data instanceof ArrayBuffer) this.handlers.onBinary(event.data);
    };
    socket.onclose = () => {
      this.dropped(socket);
    };
  }

  /** Tries at once instead of waiting for the next attempt. */
  retryNow(): void {
    if (this.socket === null) this.start();
  }

  /** The bridge wants a token first: no more attempts until `retryNow`. */
  signedOut(): void {
    if (this.socket !== null) return;
    clearTimeout(this.timer);
    this.handlers.onState({ kind: "signed out" });
  }

  /** False when there is nobody to send to. */
  send(text: string): boolean {
    if (this.socket === null) return false;
    try {
      this.socket.send(text);
      return true;
    } catch {
      return false; // still connecting
    }
  }

  private expectData(socket: Socket): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      socket.close();
      this.dropped(socket);
    }, kSilence_ms);
  }

  private dropped(socket: Socket): void {
    if (socket !== this.socket) return; // an older one, given up before
    this.socket = null;
    clearTimeout(this.timer);
    const delay_ms = Math.min(kFirstDelay_ms * 2 ** this.failures, kLongestDelay_ms);
    this.failures += 1;
    this.handlers.onState({
      kind: "waiting",
      attempt: this.failures,
      retry_at_ms: performance.now() + delay_ms,
    });
    this.timer = setTimeout(() => {
      this.start();
    }, delay_ms);
  }
}
