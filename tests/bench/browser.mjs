/** A Chromium without a GPU, as on a machine that only serves, and what it is given to show. */
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";

const web = createRequire(fileURLToPath(new URL("../../web/package.json", import.meta.url)));
const { chromium } = web("playwright-core");
export const { inflateSync } = web("fflate");

const kTypes = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json" };

export async function openBrowser() {
  const profile = mkdtempSync(`${tmpdir()}/skein-bench-`);
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
    viewport: { width: 1280, height: 720 },
    colorScheme: "dark",
  });
  return {
    profile,
    context,
    page: context.pages()[0],
    async close() {
      await context.close();
      rmSync(profile, { recursive: true, force: true });
    },
  };
}

/** Runs in the page: notes when the fleet's canvas was drawn, in window.drawn_at_ms (of the machine's clock). */
export function noteDrawings() {
  window.drawn_at_ms = [];
  const clear = CanvasRenderingContext2D.prototype.clearRect;
  CanvasRenderingContext2D.prototype.clearRect = function (...box) {
    clear.apply(this, box);
    // On the screen it is with the frame that ends now, before the next one begins.
    if (this.canvas.className === "overlay fleet")
      requestAnimationFrame(() => window.drawn_at_ms.push(performance.timeOrigin + performance.now()));
  };
}

/** Serves a built page, without a bridge. */
export function serve(dist) {
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

/** Drags the map about and turns the wheel, without a pause, and always back to where it was: so the fleet stays in view. */
export async function move(page, until_ms) {
  await page.mouse.move(640, 300);
  for (let i = 0; Date.now() < until_ms; i += 1) {
    await page.mouse.down();
    // A loop, to one side and then to the other.
    const way = i % 2 === 0 ? 1 : -1;
    for (let k = 0; k <= 20; k += 1) {
      const turn = (2 * Math.PI * k) / 20;
      await page.mouse.move(640 + 70 * (1 - Math.cos(turn)) * way, 300 + 40 * Math.sin(turn) * way);
    }
    // At rest before it is let go, else the map would glide on, and away in time.
    for (let k = 0; k < 4; k += 1) await page.mouse.move(640 + (k % 2), 300);
    await page.mouse.up();
    await page.mouse.wheel(0, i % 4 < 2 ? -60 : 60);
  }
}
