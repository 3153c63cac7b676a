/**
 * Whether the page's memory stays what it is: the built page with a made-up fleet, its map panned and zoomed without a pause.
 *
 *   node tests/bench/page_heap.mjs [MINUTES] [COUNT]          (default: 30 minutes, 5000 UAVs)
 *
 * Prints once a minute, after a garbage collection, what JavaScript holds, and how many nodes and listeners there are.
 */
import { fileURLToPath } from "node:url";
import { move, openBrowser, serve } from "./browser.mjs";
import { madeUpFleet } from "./made_up_fleet.mjs";

const minutes = Number(process.argv[2] ?? 30);
const count = Number(process.argv[3] ?? 5000);

const server = await serve(fileURLToPath(new URL("../../web/dist", import.meta.url)));
const browser = await openBrowser();
const { page, context } = browser;
await page.addInitScript(madeUpFleet, count);
await page.goto(`http://127.0.0.1:${server.address().port}/`);
const inspector = await context.newCDPSession(page);
await inspector.send("Performance.enable");
const mb = (bytes) => (bytes / 1e6).toFixed(1);
const begin_ms = Date.now();
for (let minute = 1; minute <= minutes; minute += 1) {
  await move(page, begin_ms + minute * 60_000);
  await inspector.send("HeapProfiler.collectGarbage");
  const { usedSize, backingStorageSize = 0 } = await inspector.send("Runtime.getHeapUsage");
  const { metrics } = await inspector.send("Performance.getMetrics");
  const value = (name) => metrics.find((metric) => metric.name === name)?.value ?? 0;
  console.log(
    `${minute} min: heap ${mb(usedSize)} MB, buffers ${mb(backingStorageSize)} MB, ` +
      `${value("Nodes")} nodes, ${value("JSEventListeners")} listeners`,
  );
}
await browser.close();
server.close();
