/**
 * From `scripts/run`, everything built, to the first frame of the page that shows the fleet.
 *
 *   node tests/bench/first_frame.mjs [RUNS]
 *
 * The browser is there already, as an operator's is; it opens the page as soon as the port answers.
 */
import { spawn } from "node:child_process";
import { once } from "node:events";
import { fileURLToPath } from "node:url";
import { noteDrawings, openBrowser } from "./browser.mjs";

const kPort = 8191;
const kUrl = `http://127.0.0.1:${kPort}/`;
const runs = Number(process.argv[2] ?? 5);
const script = fileURLToPath(new URL("../../scripts/run", import.meta.url));

const answers = () => fetch(kUrl).then((response) => response.ok, () => false);

const times = [];
for (let run = 0; run < runs; run += 1) {
  const browser = await openBrowser();
  await browser.page.addInitScript(noteDrawings);
  const began_ms = performance.timeOrigin + performance.now();
  const flight = spawn(script, ["triangle", "--port", String(kPort), "--lcm-url", "udpm://239.255.76.67:7691?ttl=0"], {
    stdio: "ignore",
  });
  while (!(await answers())) await new Promise((resolve) => setTimeout(resolve, 10));
  const answered_ms = performance.timeOrigin + performance.now();
  await browser.page.goto(kUrl, { waitUntil: "commit" });
  // A row of the table, and then the map's next frame, which has the symbols too.
  await browser.page.locator("tbody tr").first().waitFor();
  const row_ms = await browser.page.evaluate(() => performance.timeOrigin + performance.now());
  const shown = await browser.page.waitForFunction((since) => window.drawn_at_ms.find((at) => at >= since), row_ms);
  times.push({ answers_s: (answered_ms - began_ms) / 1000, shown_s: ((await shown.jsonValue()) - began_ms) / 1000 });
  flight.kill("SIGTERM");
  await once(flight, "exit");
  await browser.close();
  console.log(`run ${run + 1}: answers after ${times.at(-1).answers_s.toFixed(2)} s, shown after ${times.at(-1).shown_s.toFixed(2)} s`);
}
const shown_s = times.map((time) => time.shown_s).sort((a, b) => a - b);
console.log(`median ${shown_s[Math.floor(shown_s.length / 2)].toFixed(2)} s, worst ${shown_s.at(-1).toFixed(2)} s`);
