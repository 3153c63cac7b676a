/** A Chromium without a GPU, as on a machine that only serves. */
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { fileURLToPath } from "node:url";

const web = createRequire(fileURLToPath(new URL("../../web/package.json", import.meta.url)));
const { chromium } = web("playwright-core");
export const { inflateSync } = web("fflate");

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
