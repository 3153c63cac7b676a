/**
 * What the map costs: the built page in a Chromium without a GPU, fed with a made-up fleet by a WebSocket inside the page, so that
 * nothing else needs the machine.
 *
 *   node tests/bench/map.mjs [DIST[,DIST...]] [COUNT[,COUNT...]]
 *
 * DIST is web/dist unless named; several are measured in turn, for a comparison in one run; "markers" is what a page of Leaflet's own markers
 * costs (markers.html). SCENES=fit,zoomed,panned,moved,followed,table chooses what is measured ("moved": panned and zoomed without a pause), PROFILE=30 prints the 30 functions that took most, PICTURES=DIR keeps a screenshot of each.
 */
import { cpSync, mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { move, openBrowser, serve } from "./browser.mjs";
import { madeUpFleet } from "./made_up_fleet.mjs";

const kWeb = fileURLToPath(new URL("../../web/", import.meta.url));

const kWarmUp_ms = 4000;
const kMeasured_ms = 8000;

const dists = (process.argv[2] ?? `${kWeb}dist`).split(",");
const counts = (process.argv[3] ?? "100,1000,5000").split(",").map(Number);

/** Runs in the page. */
function closePanels() {
  for (const key of ["layout.dock_open", "layout.side_open"]) localStorage.setItem(`skein.${key}`, "false");
}

/** Runs in the page. */
function watch() {
  window.seen = { frames: 0, gaps: [], long_ms: 0, drawn: 0 };
  new PerformanceObserver((list) => {
    for (const entry of list.getEntries()) window.seen.long_ms += entry.duration - 50;
  }).observe({ type: "longtask" });
  const clear = CanvasRenderingContext2D.prototype.clearRect;
  CanvasRenderingContext2D.prototype.clearRect = function (...box) {
    if (this.canvas.className === "overlay fleet") window.seen.drawn += 1;
    clear.apply(this, box);
  };
  let last = performance.now();
  const tick = (now) => {
    window.seen.gaps.push(now - last);
    last = now;
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

/** Processor time of a process and its children [s]. */
function cpu_s(root) {
  const children = new Map();
  const times = new Map();
  for (const name of readdirSync("/proc")) {
    if (!/^\d+$/.test(name)) continue;
    try {
      const fields = readFileSync(`/proc/${name}/stat`, "utf8").replace(/^.*\) /, "").split(" ");
      const parent = Number(fields[1]);
      children.set(parent, [...(children.get(parent) ?? []), Number(name)]);
      times.set(Number(name), (Number(fields[11]) + Number(fields[12])) / 100);
    } catch {
      // It has just ended.
    }
  }
  const sum = (pid) => (times.get(pid) ?? 0) + (children.get(pid) ?? []).reduce((all, child) => all + sum(child), 0);
  return sum(root);
}

/** Where the main thread's time went: the functions that took most themselves, in ms a second. */
function printProfile({ nodes, samples, timeDeltas, startTime, endTime }) {
  const at = new Map(nodes.map((node) => [node.id, node]));
  const spent = new Map();
  samples.forEach((id, i) => {
    const { functionName, url, lineNumber, columnNumber } = at.get(id).callFrame;
    const name = `${functionName || "(anonymous)"} ${url.split("/").at(-1)}:${lineNumber + 1}:${columnNumber + 1}`;
    spent.set(name, (spent.get(name) ?? 0) + timeDeltas[i]);
  });
  const seconds = (endTime - startTime) / 1e6;
  for (const [name, us] of [...spent].sort((a, b) => b[1] - a[1]).slice(0, Number(process.env.PROFILE)))
    console.log(`${(us / 1000 / seconds).toFixed(1).padStart(7)} ms/s  ${name}`);
}

/** A page of nothing but a map with markers, in a folder of its own. */
function markersPage() {
  const folder = mkdtempSync(`${tmpdir()}/skein-markers-`);
  cpSync(`${kWeb}node_modules/leaflet/dist`, folder, { recursive: true });
  cpSync(fileURLToPath(new URL("markers.html", import.meta.url)), join(folder, "index.html"));
  return folder;
}

async function measure(dist, count, scene) {
  const served = dist === "markers" ? markersPage() : dist;
  const server = await serve(served);
  const browser = await openBrowser();
  const { page, context, profile } = browser;
  await page.addInitScript(madeUpFleet, count);
  // The page as it opens, or the map alone.
  if (scene !== "table") await page.addInitScript(closePanels);
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.waitForTimeout(kWarmUp_ms);
  if (scene === "zoomed") {
    // Nearer to a part of them: symbols, labels and slots at their largest.
    await page.mouse.move(640, 330);
    for (let i = 0; i < 3; i += 1) await page.mouse.wheel(0, -120);
    await page.waitForTimeout(500);
  }
  if (scene === "followed") {
    await page.keyboard.press("l");
    await page.mouse.move(640, 330);
    for (let i = 0; i < 3; i += 1) await page.mouse.wheel(0, -120);
    await page.waitForTimeout(500);
  }
  const inspector = await context.newCDPSession(page);
  await inspector.send("Performance.enable", { timeDomain: "threadTicks" });
  const busy_s = async () =>
    (await inspector.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
  await page.evaluate(watch);
  if (process.env.PROFILE) {
    await inspector.send("Profiler.enable");
    await inspector.send("Profiler.start");
  }
  const pid = Number(readdirSync("/proc").find((pid) => {
    try {
      return readFileSync(`/proc/${pid}/cmdline`, "utf8").includes(profile) && !readFileSync(`/proc/${pid}/cmdline`, "utf8").includes("--type=");
    } catch {
      return false;
    }
  }));
  const before = { busy_s: await busy_s(), cpu_s: cpu_s(pid) };
  if (scene === "moved") {
    await move(page, Date.now() + kMeasured_ms);
  } else if (scene === "panned") {
    await page.mouse.move(640, 300);
    await page.mouse.down();
    const end = Date.now() + kMeasured_ms;
    for (let i = 0; Date.now() < end; i += 1) await page.mouse.move(640 + 200 * Math.sin(i / 20), 300 + 60 * Math.cos(i / 20));
    await page.mouse.up();
  } else {
    await page.waitForTimeout(kMeasured_ms);
  }
  const seen = await page.evaluate("window.seen");
  if (process.env.PROFILE) printProfile((await inspector.send("Profiler.stop")).profile);
  const spent = { busy_s: (await busy_s()) - before.busy_s, cpu_s: cpu_s(pid) - before.cpu_s };
  await page.screenshot({ path: `${process.env.PICTURES ?? tmpdir()}/map-bench-${count}-${scene}.png` });
  await browser.close();
  if (served !== dist) rmSync(served, { recursive: true, force: true });
  server.close();
  const seconds = kMeasured_ms / 1000;
  const gaps = seen.gaps.sort((a, b) => a - b);
  return {
    "drawn / s": (seen.drawn / seconds).toFixed(1),
    "main ms / drawn": ((spent.busy_s * 1000) / seen.drawn).toFixed(1),
    "main ms / frame": ((spent.busy_s * 1000) / gaps.length).toFixed(1),
    "main busy %": ((100 * spent.busy_s) / seconds).toFixed(0),
    "all CPU %": ((100 * spent.cpu_s) / seconds).toFixed(0),
    "gap median ms": gaps[Math.floor(gaps.length / 2)]?.toFixed(0),
    "gap p95 ms": gaps[Math.floor(gaps.length * 0.95)]?.toFixed(0),
    "gap max ms": gaps.at(-1)?.toFixed(0),
    "blocked ms / s": (seen.long_ms / seconds).toFixed(0),
  };
}

const rows = [];
for (const count of counts) {
  for (const scene of (process.env.SCENES ?? "fit,zoomed,panned").split(",")) {
    for (const dist of dists) {
      const row = { count, scene, dist: dists.length > 1 ? dist.split("/").at(-1) : "", ...(await measure(dist, count, scene)) };
      rows.push(row);
      console.log(Object.entries(row).map(([name, value]) => `${name} ${value}`).join(", "));
    }
  }
}
console.table(rows);
