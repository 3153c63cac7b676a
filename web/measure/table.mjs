/* global process, document, performance, requestAnimationFrame */
/**
 * How smoothly the table scrolls: node measure/table.mjs [http://127.0.0.1:8080/], with a web-bridge and a fleet running.
 * Prints frame times with the table at rest, while it is scrolled, and with the charts open instead, and what a frame costs the page's main thread.
 */
import { chromium } from "playwright-core";

const kSeconds = 5;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--headless", "--no-sandbox", "--disable-gpu"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
await page.goto(process.argv[2] ?? "http://127.0.0.1:8080/");
await page.waitForSelector("tr[data-id]");
const session = await page.context().newCDPSession(page);
await session.send("Performance.enable", { timeDomain: "threadTicks" });

/** Seconds of the main thread's own CPU time so far. */
async function busy() {
  const { metrics } = await session.send("Performance.getMetrics");
  const value = (name) => metrics.find((metric) => metric.name === name)?.value ?? 0;
  return {
    script: value("ScriptDuration"),
    layout: value("LayoutDuration") + value("RecalcStyleDuration"),
    all: value("TaskDuration"),
  };
}

async function measure(what, step_px) {
  const before = await busy();
  const frames = await page.evaluate(
    async ([seconds, step]) => {
      const scroller = document.querySelector(".table-scroll, .charts");
      const times = [];
      let last = performance.now();
      for (const end = last + seconds * 1000; last < end;) {
        scroller.scrollTop =
          (scroller.scrollTop + step) % Math.max(scroller.scrollHeight - scroller.clientHeight, 1);
        const now = await new Promise(requestAnimationFrame);
        times.push(now - last);
        last = now;
      }
      return times.slice(1).sort((a, b) => a - b);
    },
    [kSeconds, step_px],
  );
  const after = await busy();
  const quantile = (part) => frames[Math.floor(part * (frames.length - 1))]?.toFixed(0);
  const cost = (name) => (((after[name] - before[name]) * 1000) / frames.length).toFixed(1);
  process.stdout.write(
    `${what}: ${frames.length} frames in ${kSeconds} s, median ${quantile(0.5)} ms, 95% within ${quantile(0.95)} ms; ` +
      `of the main thread's CPU a frame: script ${cost("script")} ms, style and layout ${cost("layout")} ms, all ${cost("all")} ms\n`,
  );
}

await page.waitForTimeout(3000);
const rows = await page.locator("tr[data-id]").count();
const total = await page.getByRole("grid").getAttribute("aria-rowcount");
process.stdout.write(`${Number(total) - 1} UAVs, ${rows} rows exist\n`);
await measure("at rest  ", 0);
await measure("scrolling", 96);
await page.getByRole("tab", { name: "Charts" }).click();
await page.waitForSelector(".chart");
await measure("charts   ", 0);
await browser.close();
