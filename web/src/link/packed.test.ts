import { deflateSync, strToU8 } from "fflate";
import { expect, test } from "vitest";
import { unpack } from "./packed";

/** Packs as the protocol's description says. */
function pack(content: Uint8Array, what: number, bytes = content.length): ArrayBuffer {
  const deflated = deflateSync(content);
  const packed = new Uint8Array(8 + deflated.length);
  packed.set([4, 1, what]);
  new DataView(packed.buffer).setUint32(4, bytes, true);
  packed.set(deflated, 8);
  return packed.buffer;
}

test("a text is what it was", () => {
  const text = JSON.stringify({ type: "statuses", text: "Höhe" });
  expect(unpack(pack(strToU8(text), 0))).toBe(text);
});

test("the bytes of a frame are put back into their words", () => {
  // Words a, b; then two bytes more.
  const sorted = new Uint8Array([10, 20, 11, 21, 12, 22, 13, 23, 1, 2]);
  const frame = unpack(pack(sorted, 1)) as ArrayBuffer;
  expect([...new Uint8Array(frame)]).toEqual([10, 11, 12, 13, 20, 21, 22, 23, 1, 2]);
});

test("what isn't packed is left alone", () => {
  for (const bytes of [[], [1, 1, 0, 0], [2]]) {
    const { buffer } = new Uint8Array(bytes);
    expect(unpack(buffer)).toBe(buffer);
  }
});

test("what is damaged is refused", () => {
  const whole = pack(new Uint8Array(5000), 1);
  expect(unpack(new Uint8Array([4, 1]).buffer)).toBeNull();
  expect(unpack(whole.slice(0, whole.byteLength - 4))).toBeNull();
  expect(unpack(pack(new Uint8Array(100), 1, 101))).toBeNull();
  const newer = whole.slice(0);
  new Uint8Array(newer)[1] = 2;
  expect(unpack(newer)).toBeNull();
});
