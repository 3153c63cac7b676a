import { describe, expect, test } from "vitest";
import { decodeFrame, kHasPayload, kPayloadOn, type MotionFrame, type StatusFrame } from "./frames";

/** Writes a frame as the protocol's description says, column by column. */
function encode(
  kind: number,
  columns: { type: "i32" | "f32" | "u8"; values: number[] }[],
  version = 1,
): ArrayBuffer {
  const count = columns[0]?.values.length ?? 0;
  const bytes = columns.reduce((sum, c) => sum + (c.type === "u8" ? 1 : 4) * count, 24);
  const view = new DataView(new ArrayBuffer(bytes));
  view.setUint8(0, kind);
  view.setUint8(1, version);
  view.setUint32(4, count, true);
  view.setFloat64(8, 1577836800050000, true);
  view.setFloat64(16, 12.05, true);
  let at = 24;
  for (const { type, values } of columns) {
    for (const value of values) {
      if (type === "i32") view.setInt32(at, value, true);
      else if (type === "f32") view.setFloat32(at, value, true);
      else view.setUint8(at, value);
      at += type === "u8" ? 1 : 4;
    }
  }
  return view.buffer;
}

const f32 = (...values: number[]) => ({ type: "f32" as const, values });
const i32 = (...values: number[]) => ({ type: "i32" as const, values });
const u8 = (...values: number[]) => ({ type: "u8" as const, values });

const kMotion = [
  i32(7, 9),
  f32(100, -100),
  f32(200, -200),
  f32(1000, 800),
  f32(60, 50.5),
  f32(1.5, -1.5),
  f32(0.1, 0),
  f32(0.05, 4),
  u8(3, 2),
];

const kStatus = [
  i32(7, 9),
  i32(1, 0),
  ...[1, 2, 3].map((n) => f32(n, -n)),
  i32(9, 0),
  f32(500, -1),
  f32(10, -1),
  i32(0, 7),
  f32(4, -4),
  i32(0, 7),
  ...[5, 6, 7, 8, 9, 10, 11].map((n) => f32(n, -n)),
  u8(0, 3),
  u8(0, 2),
  u8(1, 3),
  u8(3, 0),
];

describe("decodeFrame", () => {
  test("reads motion", () => {
    const frame = decodeFrame(encode(1, kMotion)) as MotionFrame;
    expect(frame.kind).toBe("motion");
    expect(frame.utime).toBe(1577836800050000);
    expect(frame.t_s).toBe(12.05);
    expect([...frame.id]).toEqual([7, 9]);
    expect([...frame.north_m]).toEqual([200, -200]);
    expect([...frame.speed_m_s]).toEqual([60, 50.5]);
    expect(frame.age_s[1]).toBe(4);
    expect(frame.flags[0]).toBe(kPayloadOn | kHasPayload);
  });

  test("reads status", () => {
    const frame = decodeFrame(encode(2, kStatus)) as StatusFrame;
    expect(frame.kind).toBe("status");
    expect([...frame.formation_id]).toEqual([1, 0]);
    expect([...frame.up_error_m]).toEqual([3, -3]);
    expect([...frame.nearest_id]).toEqual([9, 0]);
    expect([...frame.tau_id]).toEqual([0, 7]);
    expect([...frame.tau_s]).toEqual([4, -4]);
    expect([...frame.level_with_id]).toEqual([0, 7]);
    expect([...frame.vertical_uncertainty_m]).toEqual([11, -11]);
    expect([...frame.level]).toEqual([0, 3]);
    expect([...frame.uplink]).toEqual([1, 3]);
    expect([...frame.flags]).toEqual([3, 0]);
  });

  test("reads an empty fleet", () => {
    expect(decodeFrame(encode(1, []))?.count).toBe(0);
  });

  test("refuses what it doesn't know", () => {
    expect(decodeFrame(encode(3, kMotion))).toBeNull();
    expect(decodeFrame(encode(1, kMotion, 2))).toBeNull();
  });

  test("refuses every wrong length", () => {
    const whole = encode(1, kMotion);
    for (let bytes = 0; bytes < whole.byteLength; bytes += 1)
      expect(decodeFrame(whole.slice(0, bytes))).toBeNull();
    const longer = new ArrayBuffer(whole.byteLength + 1);
    new Uint8Array(longer).set(new Uint8Array(whole));
    expect(decodeFrame(longer)).toBeNull();
    const hostile = whole.slice(0);
    new DataView(hostile).setUint32(4, 0xffffffff, true);
    expect(decodeFrame(hostile)).toBeNull();
  });
});
