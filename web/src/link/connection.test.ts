import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { Connection, type ConnectionState, type Socket } from "./connection";

class FakeSocket implements Socket {
  binaryType = "blob";
  onopen: Socket["onopen"] = null;
  onmessage: Socket["onmessage"] = null;
  onclose: Socket["onclose"] = null;
  sent: string[] = [];
  closed = false;
  send(text: string): void {
    this.sent.push(text);
  }
  close(): void {
    this.closed = true;
  }
  opens(): void {
    this.onopen?.({} as Event);
  }
  hears(data: unknown): void {
    this.onmessage?.({ data } as MessageEvent<unknown>);
  }
  closes(): void {
    this.onclose?.({} as CloseEvent);
  }
}

let sockets: FakeSocket[];
let states: ConnectionState[];
let texts: string[];
let connection: Connection;

const last = () => sockets[sockets.length - 1] as FakeSocket;
const state = () => states[states.length - 1]?.kind;

beforeEach(() => {
  vi.useFakeTimers();
  sockets = [];
  states = [];
  texts = [];
  connection = new Connection(
    () => {
      const socket = new FakeSocket();
      sockets.push(socket);
      return socket;
    },
    { onState: (s) => states.push(s), onText: (t) => texts.push(t), onBinary: () => undefined },
  );
  connection.start();
});

afterEach(() => vi.useRealTimers());

test("opens and hands on what it hears", () => {
  expect(state()).toBe("connecting");
  last().opens();
  expect(state()).toBe("open");
  last().hears("hello");
  expect(texts).toEqual(["hello"]);
  expect(last().binaryType).toBe("arraybuffer");
});

test("waits longer and longer between attempts, 5 s at most", () => {
  const delays_ms: number[] = [];
  for (let i = 0; i < 6; i += 1) {
    last().closes();
    const waiting = states[states.length - 1];
    if (waiting?.kind !== "waiting") throw new Error("not waiting");
    expect(waiting.attempt).toBe(i + 1);
    delays_ms.push(waiting.retry_at_ms - performance.now());
    vi.advanceTimersToNextTimer();
    expect(state()).toBe("connecting");
  }
  expect(delays_ms).toEqual([500, 1000, 2000, 4000, 5000, 5000]);
});

test("starts over with a short wait after it was open", () => {
  last().closes();
  vi.advanceTimersByTime(500);
  last().opens();
  last().closes();
  vi.advanceTimersByTime(500);
  expect(sockets).toHaveLength(3);
});

test("takes a silent link for a dead one", () => {
  last().opens();
  vi.advanceTimersByTime(9000);
  last().hears("still here");
  vi.advanceTimersByTime(9000);
  expect(state()).toBe("open");
  vi.advanceTimersByTime(1001);
  expect(state()).toBe("waiting");
  expect(last().closed).toBe(true);
});

test("gives up an attempt that nobody answers", () => {
  vi.advanceTimersByTime(9999);
  expect(state()).toBe("connecting");
  vi.advanceTimersByTime(1);
  expect(state()).toBe("waiting");
  expect(last().closed).toBe(true);
  vi.advanceTimersByTime(500);
  expect(sockets).toHaveLength(2);
});

test("a late close of a socket that was given up changes nothing", () => {
  const first = last();
  first.opens();
  vi.advanceTimersByTime(10_500);
  last().opens();
  first.closes();
  expect(state()).toBe("open");
});

test("tries at once when asked, and not twice", () => {
  last().closes();
  connection.retryNow();
  expect(sockets).toHaveLength(2);
  connection.retryNow();
  vi.advanceTimersByTime(600);
  expect(sockets).toHaveLength(2);
});

test("says when there is nobody to send to", () => {
  last().opens();
  expect(connection.send("x")).toBe(true);
  last().closes();
  expect(connection.send("x")).toBe(false);
});

test("signed out, it tries no more until it is asked to", () => {
  last().closes();
  connection.signedOut();
  expect(state()).toBe("signed out");
  vi.advanceTimersByTime(60_000);
  expect(sockets).toHaveLength(1);
  connection.retryNow();
  expect(sockets).toHaveLength(2);
});
