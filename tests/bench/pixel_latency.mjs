/**
 * How old what a page shows is: from the tick of the simulator to the frame of the screen that has it.
 *
 *   node tests/bench/pixel_latency.mjs [SECONDS]
 *
 * of the flight at port SKEIN_PORT (8080) of this machine, whose clock both ends read.
 */
import { inflateSync, noteDrawings, openBrowser } from "./browser.mjs";

const kWarmUp_ms = 5000;
const seconds = Number(process.argv[2] ?? 20);

/** Runs in the page: keeps every binary message with the time at which it came. */
function keepMessages() {
  window.came = [];
  const Real = window.WebSocket;
  window.WebSocket = class extends Real {
    constructor(...how) {
      super(...how);
      this.addEventListener("message", ({ data }) => {
        if (data instanceof ArrayBuffer)
          window.came.push({ at_ms: performance.timeOrigin + performance.now(), bytes: Array.from(new Uint8Array(data)) });
      });
    }
  };
}

/** Time of the tick in a motion frame [ms]; null: the message is something else. */
function tickOf(bytes) {
  let frame = new Uint8Array(bytes);
  if (frame[0] === 4) {
    if (frame[2] !== 1) return null;
    const sorted = inflateSync(frame.subarray(8));
    const words = sorted.length >> 2;
    // Of the header, which is all that is wanted.
    frame = Uint8Array.from({ length: 24 }, (_, i) => sorted[(i % 4) * words + (i >> 2)]);
  }
  return frame[0] === 1 ? new DataView(frame.buffer, frame.byteOffset).getFloat64(8, true) / 1000 : null;
}

const browser = await openBrowser();
await browser.page.addInitScript(noteDrawings);
await browser.page.addInitScript(keepMessages);
await browser.page.goto(`http://127.0.0.1:${process.env.SKEIN_PORT ?? 8080}/`);
await browser.page.waitForTimeout(kWarmUp_ms);
await browser.page.evaluate(() => (window.came.length = window.drawn_at_ms.length = 0));
await browser.page.waitForTimeout(seconds * 1000);
const { came, drawn_at_ms } = await browser.page.evaluate(() => ({ came: window.came, drawn_at_ms: window.drawn_at_ms }));
await browser.close();

const latencies_ms = [];
const on_the_way_ms = [];
for (const { at_ms, bytes } of came) {
  const tick_ms = tickOf(bytes);
  const shown_ms = drawn_at_ms.find((drawn_ms) => drawn_ms >= at_ms);
  if (tick_ms === null || shown_ms === undefined) continue;
  on_the_way_ms.push(at_ms - tick_ms);
  latencies_ms.push(shown_ms - tick_ms);
}
const quantile = (values, part) => values.sort((a, b) => a - b)[Math.floor(part * (values.length - 1))]?.toFixed(0);
for (const [what, values] of [
  ["tick to browser", on_the_way_ms],
  ["tick to pixel", latencies_ms],
])
  console.log(`${what}: median ${quantile(values, 0.5)} ms, p95 ${quantile(values, 0.95)} ms, worst ${quantile(values, 1)} ms, ${values.length} frames`);
