/**
 * What the map costs: the built page in a Chromium without a GPU, fed with a made-up fleet by a WebSocket inside the page, so that
 * nothing else needs the machine.
 *
 *   node tests/bench/map.mjs [DIST[,DIST...]] [COUNT[,COUNT...]]
 *
 * DIST is web/dist unless named; several are measured in turn, for a comparison in one run. SCENES=fit,zoomed,panned,followed,table chooses what
 * is measured, PROFILE=30 prints the 30 functions that took most, PICTURES=DIR keeps a screenshot of each.
 */
import { createServer } from "node:http";
import { readFileSync, readdirSync } from "node:fs";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";

const kWeb = fileURLToPath(new URL("../../web/", import.meta.url));
const { chromium } = createRequire(`${kWeb}package.json`)("playwright-core");

const kTypes = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json" };
const kWarmUp_ms = 4000;
const kMeasured_ms = 8000;

const dists = (process.argv[2] ?? `${kWeb}dist`).split(",");
const counts = (process.argv[3] ?? "100,1000,5000").split(",").map(Number);

/** Runs in the page: a WebSocket that says what web-bridge would say of `count` UAVs, in tens, most of them alerting. */
function madeUpFleet(count) {
  const kOrigin = { latitude_deg: 40.08, longitude_deg: 116.58, altitude_m: 0 };
  const kSpeed_m_s = 50;
  const columns = Math.ceil(Math.sqrt(count / 10));
  const start_ms = performance.now();
  const utime = () => 1.7e15 + (performance.now() - start_ms) * 1000;
  const placeOf = (i) => {
    const [formation, member] = [Math.floor(i / 10), i % 10];
    const side = member % 2 === 0 ? 1 : -1;
    const rank = Math.ceil(member / 2);
    return {
      east_m: (formation % columns) * 4000 + side * rank * 180,
      north_m: Math.floor(formation / columns) * 3000 - rank * 180,
      up_m: 1000 + (formation % 5) * 100,
    };
  };
  const way_m = () => ((utime() - 1.7e15) / 1e6) * kSpeed_m_s;
  const level = (i) => (i % 10 < 6 ? 1 + (i % 3) : 0);

  function frame(kind, words, bytes, fill) {
    const buffer = new ArrayBuffer(24 + count * (4 * words + bytes));
    const header = new DataView(buffer);
    header.setUint8(0, kind);
    header.setUint8(1, 1);
    header.setUint32(4, count, true);
    header.setFloat64(8, utime(), true);
    header.setFloat64(16, (utime() - 1.7e15) / 1e6, true);
    let at = 24;
    fill((Type, value) => {
      const column = new Type(buffer, at, count);
      for (let i = 0; i < count; i += 1) column[i] = value(i);
      at += column.byteLength;
    });
    return buffer;
  }

  function motion() {
    const way = way_m();
    return frame(1, 8, 1, (column) => {
      column(Int32Array, (i) => i + 1);
      column(Float32Array, (i) => placeOf(i).east_m);
      column(Float32Array, (i) => placeOf(i).north_m + way);
      column(Float32Array, (i) => placeOf(i).up_m);
      column(Float32Array, () => kSpeed_m_s);
      column(Float32Array, () => Math.PI / 2);
      column(Float32Array, () => 0);
      column(Float32Array, () => 0.02);
      column(Uint8Array, () => 0);
    });
  }

  function status() {
    return frame(2, 18, 4, (column) => {
      column(Int32Array, (i) => i + 1);
      column(Int32Array, (i) => Math.floor(i / 10) + 1);
      for (let k = 0; k < 3; k += 1) column(Float32Array, () => 5);
      const partner = (i) => (i % 2 === 0 ? i + 2 : i);
      column(Int32Array, partner);
      column(Float32Array, () => 360);
      column(Float32Array, () => 0);
      column(Int32Array, partner);
      column(Float32Array, () => 20);
      for (let k = 10; k < 17; k += 1) column(Float32Array, () => 0);
      column(Int32Array, partner);
      column(Uint8Array, level);
      column(Uint8Array, () => 0);
      column(Uint8Array, () => 0);
      column(Uint8Array, () => 3);
    });
  }

  function formationStatus(formation) {
    const way = way_m();
    const members = Array.from({ length: Math.min(10, count - formation * 10) }, (_, k) => formation * 10 + k);
    const leader = placeOf(formation * 10);
    return {
      type: "status",
      utime: utime(),
      formation_id: formation + 1,
      mode: 2,
      mode_utime: utime(),
      mode_end_utime: 0,
      mode_text: "in formation",
      leader_east_m: leader.east_m,
      leader_north_m: leader.north_m + way + 1000,
      leader_up_m: leader.up_m,
      leader_speed_m_s: kSpeed_m_s,
      leader_course_rad: Math.PI / 2,
      slots: members.map((i) => {
        const { east_m, north_m, up_m } = placeOf(i);
        return { vehicle_id: i + 1, slot_east_m: east_m + 8, slot_north_m: north_m + way + 8, slot_up_m: up_m, flown: true };
      }),
    };
  }

  window.WebSocket = class extends EventTarget {
    static OPEN = 1;
    readyState = 0;
    binaryType = "arraybuffer";
    constructor() {
      super();
      setTimeout(() => this.begin(), 200);
    }
    begin() {
      this.readyState = 1;
      this.tell("open", new Event("open"));
      const formations = Math.ceil(count / 10);
      const text = (message) => this.tell("message", new MessageEvent("message", { data: JSON.stringify(message) }));
      const binary = (data) => this.tell("message", new MessageEvent("message", { data }));
      text({ type: "hello", version: "bench", lcm_url: "", utime: utime(), tile_url: null, tile_attribution: "", tiles: null });
      const vehicles = Array.from({ length: count }, (_, i) => ({ id: i + 1, callsign: `UAV${i + 1}`, model: "default", has_payload: false }));
      text({ type: "roster", utime: utime(), scenario: `${count} UAVs`, start_utime: 1.7e15, origin: kOrigin, vehicles });
      setInterval(() => binary(motion()), count > 100 ? 200 : 100);
      setInterval(() => binary(status()), 500);
      let next = 0;
      // Each formation five times a second, spread out as on a bus.
      setInterval(() => {
        for (let k = 0; k < formations / 5; k += 1) text(formationStatus((next = (next + 1) % formations)));
      }, 40);
    }
    tell(type, event) {
      this[`on${type}`]?.(event);
      this.dispatchEvent(event);
    }
    send() {}
    close() {}
  };
}

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

function serve(dist) {
  const server = createServer((request, response) => {
    const path = request.url === "/" ? "/index.html" : request.url.replace(/\?.*/, "");
    try {
      const content = readFileSync(join(dist, path));
      response.writeHead(200, { "Content-Type": kTypes[extname(path)] ?? "application/octet-stream" }).end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

async function measure(dist, count, scene) {
  const server = await serve(dist);
  const profile = mkdtempSync(`${tmpdir()}/skein-bench-`);
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
    viewport: { width: 1280, height: 720 },
    colorScheme: "dark",
  });
  const page = context.pages()[0];
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
  const browser = Number(readdirSync("/proc").find((pid) => {
    try {
      return readFileSync(`/proc/${pid}/cmdline`, "utf8").includes(profile) && !readFileSync(`/proc/${pid}/cmdline`, "utf8").includes("--type=");
    } catch {
      return false;
    }
  }));
  const before = { busy_s: await busy_s(), cpu_s: cpu_s(browser) };
  if (scene === "panned") {
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
  const spent = { busy_s: (await busy_s()) - before.busy_s, cpu_s: cpu_s(browser) - before.cpu_s };
  await page.screenshot({ path: `${process.env.PICTURES ?? tmpdir()}/map-bench-${count}-${scene}.png` });
  await context.close();
  rmSync(profile, { recursive: true, force: true });
  server.close();
  const seconds = kMeasured_ms / 1000;
  const gaps = seen.gaps.sort((a, b) => a - b);
  return {
    "drawn / s": (seen.drawn / seconds).toFixed(1),
    "main ms / drawn": ((spent.busy_s * 1000) / seen.drawn).toFixed(1),
    "main busy %": ((100 * spent.busy_s) / seconds).toFixed(0),
    "all CPU %": ((100 * spent.cpu_s) / seconds).toFixed(0),
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
