/** The page as a person sees and uses it. */
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { fileURLToPath } from "node:url";
import axe from "axe-core";
import { chromium, type BrowserContext, type Locator, type Page } from "playwright-core";
import { afterEach, expect, vi } from "vitest";
import { kPageUrl } from "./station";

const kResults = fileURLToPath(new URL("test-results/", import.meta.url));
const kFlags = [
  "--headless",
  "--no-sandbox",
  "--disable-gpu",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--no-first-run",
];

/** Waits for what a person would wait for; fails with what was still wrong. */
export const until = (what: () => Promise<void> | void, timeout = 20_000): Promise<void> =>
  vi.waitFor(what, { timeout, interval: 50 });

/** Whether it comes in sight within that time. */
export const appears = (what: Locator, timeout: number): Promise<boolean> =>
  what.waitFor({ timeout }).then(
    () => true,
    () => false,
  );

export interface Uav {
  level: string;
  downlink: string;
  uplink: string;
  forward_error_m: number;
  altitude_m: number;
  speed_m_s: number;
  payload_on: boolean;
}

export interface Centre {
  x: number;
  y: number;
}

const open_screens = new Set<Screen>();

// What a person would have seen when a test failed.
afterEach(async ({ task }) => {
  if (task.result?.state !== "fail") return;
  const name = `failed-${task.file.name}-${task.name}`.replace(/[^a-z0-9]+/gi, "-");
  for (const [i, { page }] of [...open_screens].entries())
    await page.screenshot({ path: `${kResults}${name}-${i + 1}.png` });
});

export class Screen {
  /** Errors on the console and unhandled rejections. */
  readonly complaints: string[] = [];
  /** Requests to other hosts than the bridge. */
  readonly strangers: string[] = [];

  private constructor(
    private readonly context: BrowserContext,
    private readonly profile: string,
    readonly page: Page,
  ) {
    page.on("console", (message) => {
      if (message.type() !== "error" && message.type() !== "warning") return;
      const where = message.text().startsWith("Failed to load") ? ` ${message.location().url}` : "";
      this.complaints.push(message.text() + where);
    });
    page.on("pageerror", (error) => this.complaints.push(String(error)));
    context.on("request", (request) => {
      if (!request.url().startsWith(kPageUrl) && !request.url().startsWith("data:"))
        this.strangers.push(request.url());
    });
  }

  /** @param path after the page's address */
  static async open(path = ""): Promise<Screen> {
    mkdirSync(kResults, { recursive: true });
    const profile = mkdtempSync(`${tmpdir()}/skein-browser-`);
    const context = await chromium.launchPersistentContext(profile, {
      executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium",
      args: kFlags,
      viewport: { width: 1280, height: 720 },
      colorScheme: "dark",
    });
    const page = context.pages()[0] ?? (await context.newPage());
    const screen = new Screen(context, profile, page);
    open_screens.add(screen);
    await page.goto(kPageUrl + path);
    return screen;
  }

  async close(): Promise<void> {
    open_screens.delete(this);
    await this.context.close();
    rmSync(this.profile, { recursive: true, force: true });
  }

  row(id: number): Locator {
    return this.page.locator(`tr[data-id="${id}"]`);
  }

  /** A row of the table, read like a person reads it. */
  uav(id: number): Promise<Uav> {
    return this.row(id).evaluate((row) => {
      const number = (selector: string) =>
        Number(
          (row.querySelector(selector)?.textContent || "NaN").replace("\u2212", "-").replace("—", "NaN"),
        );
      const label = (selector: string) => row.querySelector(selector)?.getAttribute("aria-label") ?? "";
      return {
        level: label(".lamp"),
        downlink: label('.chain[aria-label^="Downlink"]').replace("Downlink ", ""),
        uplink: label('.chain[aria-label^="Uplink"]').replace("Uplink ", ""),
        forward_error_m: number(".error"),
        altitude_m: number(".altitude"),
        speed_m_s: number(".speed"),
        payload_on: row.querySelector('[role="switch"]')?.getAttribute("aria-checked") === "true",
      };
    });
  }

  /** When the newest event of a kind happened, as the list says [s since the start]. */
  async eventTime_s(code: string): Promise<number> {
    const time = this.page.locator(`.events li[title*=": ${code},"] time`).first();
    const [hours = NaN, minutes = NaN, seconds = NaN] = (await time.innerText())
      .replace("T+ ", "")
      .split(":")
      .map(Number);
    return 3600 * hours + 60 * minutes + seconds;
  }

  /** How long the flight that is shown has been under way, as its clock says [s]. */
  async elapsed_s(): Promise<number> {
    const text = (await this.page.locator(".elapsed").innerText()).replace("T+ ", "");
    return text.split(":").reduce((sum, part) => 60 * sum + Number(part), 0);
  }

  /** Waits until the flight has gone on by so much. */
  async flies(duration_s: number): Promise<void> {
    const from_s = await this.elapsed_s();
    await until(async () => expect((await this.elapsed_s()) - from_s).toBeGreaterThanOrEqual(duration_s));
  }

  button(name: string): Locator {
    return this.page.getByRole("button", { name, exact: true });
  }

  payload(callsign: string): Locator {
    return this.page.getByRole("switch", { name: `Payload of ${callsign}`, exact: true });
  }

  text(selector: string): Promise<string> {
    return this.page.locator(selector).innerText();
  }

  /**
   * Where on the page a UAV's symbol is, drawn on the map or on another canvas: the middle of the pixels in its identity colour.
   * Null: it isn't to be seen.
   */
  symbol(id: number, canvas = "canvas.fleet"): Promise<Centre | null> {
    return this.page.evaluate(
      ([identity, selector]) => {
        const drawn = document.querySelector<HTMLCanvasElement>(selector);
        if (drawn === null) return null;
        const canvas = new OffscreenCanvas(drawn.width, drawn.height);
        const context = canvas.getContext("2d", { willReadFrequently: true });
        if (context === null) return null;
        context.drawImage(drawn, 0, 0);
        const hex = getComputedStyle(document.documentElement)
          .getPropertyValue(`--identity-${identity}`)
          .trim();
        const [red, green, blue] = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
        const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
        let [count, x, y] = [0, 0, 0];
        for (let i = 0; i < data.length; i += 4) {
          // Only the symbol is opaque: trail, vector and slot are drawn thinner or paler.
          if (data[i] !== red || data[i + 1] !== green || data[i + 2] !== blue || data[i + 3] !== 255)
            continue;
          count += 1;
          x += (i / 4) % canvas.width;
          y += Math.floor(i / 4 / canvas.width);
        }
        // With the pixels, for a canvas moves along with the map until it is drawn again.
        const box = drawn.getBoundingClientRect();
        const drawn_px = count * (drawn.width / box.width);
        return count < 20 ? null : { x: box.x + x / drawn_px, y: box.y + y / drawn_px };
      },
      [id, canvas] as const,
    );
  }

  /**
   * How many pixels of a canvas have a colour of the stylesheet ("identity-1"), in each tenth of its width; all that are drawn at
   * all when none is named.
   */
  ink(canvas: string, token = "", tolerance = 0): Promise<number[]> {
    return this.page.locator(canvas).evaluate(
      (drawn: HTMLCanvasElement, [wanted, most_off]) => {
        const copy = new OffscreenCanvas(drawn.width, drawn.height);
        const context = copy.getContext("2d", { willReadFrequently: true });
        if (context === null) return [];
        context.drawImage(drawn, 0, 0);
        const hex = getComputedStyle(document.documentElement).getPropertyValue(`--${wanted}`).trim();
        const rgb = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
        const { data } = context.getImageData(0, 0, copy.width, copy.height);
        const tenths = new Array<number>(10).fill(0);
        for (let i = 0; i < data.length; i += 4) {
          if (data[i + 3] === 0) continue;
          if (wanted !== "" && rgb.some((value, c) => Math.abs((data[i + c] ?? 0) - value) > most_off))
            continue;
          const tenth = Math.floor((((i / 4) % copy.width) / copy.width) * 10);
          tenths[tenth] = (tenths[tenth] ?? 0) + 1;
        }
        return tenths;
      },
      [token, tolerance] as const,
    );
  }

  /** Puts fingers on the screen, moves them from place to place (each step: where each finger is), and lifts them. */
  async touch(steps: readonly (readonly Centre[])[], hold_ms = 0): Promise<void> {
    const inspector = await this.context.newCDPSession(this.page);
    const send = (type: "touchStart" | "touchMove" | "touchEnd", fingers: readonly Centre[]) =>
      inspector.send("Input.dispatchTouchEvent", {
        type,
        touchPoints: fingers.map(({ x, y }, id) => ({ x, y, id })),
      });
    for (const [i, fingers] of steps.entries()) await send(i === 0 ? "touchStart" : "touchMove", fingers);
    // A press is long by how long it lasts: there is nothing else to wait for.
    if (hold_ms > 0) await this.page.waitForTimeout(hold_ms);
    await send("touchEnd", []);
    await inspector.detach();
  }

  /** What axe finds wrong with the page for people who can't see, or not well. */
  async barriers(): Promise<string[]> {
    await this.page.evaluate(axe.source);
    const { violations } = await this.page.evaluate<axe.AxeResults>("axe.run()");
    return violations.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html}`));
  }

  /** Shows the fleet in a window of this size, in this theme. */
  async show(width: number, height: number, theme: "dark" | "light"): Promise<void> {
    await this.resize(width, height);
    await this.page.emulateMedia({ colorScheme: theme });
    await this.page.waitForFunction((wanted) => document.documentElement.dataset["theme"] === wanted, theme);
    // Where something is being typed it would only be one more letter.
    if (!(await this.page.evaluate(() => document.activeElement instanceof HTMLInputElement)))
      await this.page.keyboard.press("f");
    await this.nextFrames();
  }

  /** Makes the window this large, and waits for the page to take that on. */
  async resize(width: number, height: number): Promise<void> {
    await this.page.setViewportSize({ width, height });
    await this.page.waitForFunction((size) => `${innerWidth} ${innerHeight}` === size, `${width} ${height}`);
    await this.nextFrames();
  }

  /** What `read` gives when it has come to rest: the same again two frames later. */
  async atRest<T>(read: () => Promise<T>): Promise<T> {
    let rest = await read();
    await until(async () => {
      const before = rest;
      await this.nextFrames();
      rest = await read();
      expect(rest).toEqual(before);
    });
    return rest;
  }

  /** Waits for two frames of the screen, so that what was changed before is drawn. */
  async nextFrames(): Promise<void> {
    await this.page.evaluate(
      () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
    );
  }

  /** Also looks whether the page fills the window: what is lowest ends where it does, and what is shown of the map is no slit. */
  async picture(name: string, width: number, height: number, theme: "dark" | "light"): Promise<void> {
    await this.show(width, height, theme);
    const { lowest, map_px } = await this.page.evaluate(() => ({
      lowest: Math.max(
        ...[...document.querySelectorAll(".app > *")].map((part) => part.getBoundingClientRect().bottom),
      ),
      map_px: document.querySelector(".middle")?.getBoundingClientRect().height ?? 0,
    }));
    expect(Math.abs(lowest - height), `${name}: the lowest part ends at ${lowest}`).toBeLessThan(2);
    expect(map_px, `${name}: the map's height`).toBeGreaterThan(0.15 * height);
    await this.page.screenshot({
      path: `${kResults}${name}-${width}x${height}-${theme}.png`,
    });
  }
}
