/** Large messages of the live link come packed: a header of 8 bytes, then raw deflate. */
// The browser's own DecompressionStream answers later, when smaller messages have overtaken.
import { inflateSync } from "fflate";

const kPackedKind = 4;
const kVersion = 1;
const kHeaderBytes = 8;
const kFrame = 1;
/** More than any fleet needs: what claims to be larger is damaged. */
const kMostBytes = 1 << 28;

/** What the bridge packed: a text or a frame, or the buffer itself when it isn't packed. Null when it is damaged. */
export function unpack(buffer: ArrayBuffer): string | ArrayBuffer | null {
  const header = new DataView(buffer);
  if (buffer.byteLength === 0 || header.getUint8(0) !== kPackedKind) return buffer;
  if (buffer.byteLength < kHeaderBytes || header.getUint8(1) !== kVersion) return null;
  const bytes = header.getUint32(4, true);
  if (bytes > kMostBytes) return null;
  let content: Uint8Array;
  try {
    content = inflateSync(new Uint8Array(buffer, kHeaderBytes), { out: new Uint8Array(bytes) });
  } catch {
    return null;
  }
  if (content.length !== bytes) return null;
  return header.getUint8(2) === kFrame ? unsorted(content) : new TextDecoder().decode(content);
}

/** All first bytes of the words come first, then all second ones, ...: as they pack best. */
function unsorted(sorted: Uint8Array): ArrayBuffer {
  const frame = new Uint8Array(sorted.length);
  const words = sorted.length >> 2;
  for (let first = 0; first < 4; first += 1)
    for (let word = 0; word < words; word += 1) frame[4 * word + first] = sorted[first * words + word];
  frame.set(sorted.subarray(4 * words), 4 * words);
  return frame.buffer;
}
