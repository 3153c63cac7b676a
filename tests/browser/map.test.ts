/** The map: threats, trails, tools, layers and base maps, as a person at the page sees them. */
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { afterAll, beforeAll, expect, onTestFailed, test, vi } from "vitest";
import { Screen } from "./screen";
import { Station } from "./station";
import { writePmtiles, writeTileFolder } from "./tiles_for_tests";

const kFolder = mkdtempSync(`${tmpdir()}/skein-tiles-`);
const kFolderColour = [90, 140, 60] as const;
const kArchiveColour = [60, 90, 150] as const;

const station = new Station({ scenario: "map.json", bridge: ["--tiles", `${kFolder}/county`] });
const with_archive = new Station({ scenario: "map.json", bridge: ["--tiles", `${kFolder}/area.pmtiles`] });
let screen: Screen;

const until = (what: () => Promise<void> | void, timeout = 15_000) =>
  vi.waitFor(what, { timeout, interval: 100 });

function explain(): void {
  onTestFailed(() => {
    process.stderr.write(`${station.log()}\n${with_archive.log()}\n`);
  });
}

beforeAll(async () => {
  writeTileFolder(`${kFolder}/county`, 40.09, 116.58, kFolderColour);
  writePmtiles(`${kFolder}/area.pmtiles`, kArchiveColour);
  station.start("web-bridge");
  await station.answers();
  screen = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  await Promise.all([station.stopAll(), with_archive.stopAll()]);
  rmSync(kFolder, { recursive: true, force: true });
});

/** How many pixels of a canvas of the map have a colour of the stylesheet; all that are drawn at all when none is named. */
function pixels(canvas: "fleet" | "ground", token?: string): Promise<number> {
  return screen.page.evaluate(
    ([name, wanted]) => {
      const drawn = document.querySelector<HTMLCanvasElement>(`canvas.${name}`);
      if (drawn === null) return 0;
      const copy = new OffscreenCanvas(drawn.width, drawn.height);
      const context = copy.getContext("2d", { willReadFrequently: true });
      if (context === null) return 0;
      context.drawImage(drawn, 0, 0);
      const hex = getComputedStyle(document.documentElement).getPropertyValue(`--${wanted}`).trim();
      const rgb = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
      const { data } = context.getImageData(0, 0, copy.width, copy.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] === 0) continue;
        if (wanted === "" || rgb.every((value, c) => Math.abs((data[i + c] ?? 0) - value) < 8)) count += 1;
      }
      return count;
    },
    [canvas, token ?? ""] as const,
  );
}

const menu = () => screen.button("Layers of the map");
const layer = (label: string) => screen.page.getByLabel(label, { exact: true });

async function bounds(): Promise<{ x: number; y: number; width: number; height: number }> {
  const box = await screen.page.locator(".free").boundingBox();
  if (box === null) throw new Error("no map");
  return box;
}

test("a threat is amber, then red, with lines to the closest point of approach", async () => {
  explain();
  // The page first: it must not miss the beginning.
  station.start("fleet-simulator", "formation-controller", "collision-monitor");
  await until(async () => expect(await screen.row(2).count()).toBe(1), 30_000);
  await until(async () => expect((await screen.uav(2)).level).toBe("Caution"), 30_000);
  await screen.page.keyboard.press("f");
  await until(async () => expect(await pixels("fleet", "caution")).toBeGreaterThan(400));
  await menu().click();
  const with_lines = await pixels("fleet", "caution");
  await layer("Closest points of threats").uncheck();
  await until(async () => expect(await pixels("fleet", "caution")).toBeLessThan(with_lines - 20));
  await layer("Closest points of threats").check();
  await screen.page.keyboard.press("Escape");
  expect((await screen.uav(1)).level).toBe("Clear");
  await until(async () => expect((await screen.uav(2)).level).toBe("Warning"), 30_000);
  await until(async () => expect(await pixels("fleet", "warning")).toBeGreaterThan(400));
  await screen.page.screenshot({ path: `${import.meta.dirname}/test-results/map-warning.png` });
});

test("trails are of all, of the selected or of nobody", async () => {
  explain();
  await menu().click();
  for (const label of ["Grid", "Paths and waypoints"]) await layer(label).uncheck();
  const choose = (name: string) => screen.page.getByRole("radio", { name, exact: true }).check();
  await choose("None");
  await until(async () => expect(await pixels("ground")).toBe(0));
  await choose("All");
  await until(async () => expect(await pixels("ground")).toBeGreaterThan(100), 20_000);
  await choose("Selected");
  await until(async () => expect(await pixels("ground")).toBe(0));
  await screen.page.keyboard.press("Escape");
  await screen.page.keyboard.press("n");
  await until(async () => expect(await pixels("ground")).toBeGreaterThan(30), 20_000);
  await menu().click();
  await choose("All");
  for (const label of ["Grid", "Paths and waypoints"]) await layer(label).check();
  await screen.page.keyboard.press("Escape");
});

test("a box over the map selects who is in it, Escape nobody", async () => {
  explain();
  await screen.page.keyboard.press("Escape");
  await screen.page.keyboard.press("f");
  const { x, y, width, height } = await bounds();
  await screen.page.keyboard.press("b");
  await screen.page.mouse.move(x + 5, y + 5);
  await screen.page.mouse.down();
  await screen.page.mouse.move(x + width / 2, y + height / 2);
  await screen.page.mouse.move(x + width - 5, y + height - 5);
  await screen.page.mouse.up();
  await until(async () => expect(await screen.text("main")).toContain("3 selected"));
  await screen.page.keyboard.press("Escape");
  await until(async () => expect(await screen.text("main")).not.toContain("3 selected"));
});

test("measuring tells length and bearing of each leg, by mouse and by keyboard", async () => {
  explain();
  const { x, y, width, height } = await bounds();
  await screen.page.keyboard.press("m");
  await screen.page.mouse.click(x + 60, y + height - 120);
  await screen.page.mouse.click(x + 60, y + height - 220);
  const notes = screen.page.locator(".measure-note");
  await until(async () =>
    expect(await notes.allInnerTexts()).toEqual([expect.stringMatching(/^[\d.]+ k?m, 000°$/)]),
  );
  await screen.page.mouse.click(x + width / 2, y + height - 220);
  await until(async () =>
    expect((await notes.allInnerTexts()).at(-1)).toMatch(/^[\d.]+ k?m, 090° \([\d.]+ k?m in all\)$/),
  );
  await screen.page.locator(".map").focus();
  await screen.page.keyboard.press("Enter");
  await until(async () => expect(await notes.count()).toBe(3));
  await screen.page.keyboard.press("Escape");
  await until(async () => expect(await notes.count()).toBe(0));
});

test("the readout tells where the cursor is in WGS-84, ENU and MGRS", async () => {
  explain();
  const { x, y, width, height } = await bounds();
  await screen.page.mouse.move(x + width / 2, y + height / 2);
  await until(async () => {
    const text = await screen.text(".coordinates");
    expect(text).toContain("Cursor");
    expect(text).toMatch(/40\.\d{5}° N, 116\.\d{5}° E/);
    expect(text).toMatch(/E −?\d+ m, N −?\d+ m/);
    expect(text).toMatch(/50T MK \d{5} \d{5}/);
  });
});

test("a folder of tiles lies under the fleet, and can be put away", async () => {
  explain();
  const tiles = screen.page.locator("img.leaflet-tile-loaded");
  await until(async () => expect(await tiles.count()).toBeGreaterThan(0));
  await menu().click();
  expect(await layer("county").isChecked()).toBe(true);
  for (const theme of ["dark", "light"] as const) {
    await screen.page.emulateMedia({ colorScheme: theme });
    expect(await screen.barriers()).toEqual([]);
    await screen.page.screenshot({ path: `${import.meta.dirname}/test-results/map-layers-${theme}.png` });
  }
  await screen.page.emulateMedia({ colorScheme: "dark" });
  await layer("Offline outlines").check();
  await until(async () => expect(await tiles.count()).toBe(0));
  await layer("county").check();
  await screen.page.keyboard.press("Escape");
});

test("who is lost becomes a ghost", async () => {
  explain();
  const solid = await pixels("fleet", "identity-1");
  await screen.button("Cut the link of UAV1").click();
  await until(async () => expect((await screen.uav(1)).downlink).toBe("lost"), 20_000);
  await until(async () => expect(await pixels("fleet", "identity-1")).toBeLessThan(solid / 2));
  await screen.page.screenshot({ path: `${import.meta.dirname}/test-results/map-ghost.png` });
});

test("a PMTiles file is read in parts and drawn", async () => {
  explain();
  await station.stop("web-bridge");
  with_archive.start("web-bridge");
  await with_archive.answers();
  const colour = () =>
    screen.page.evaluate(() => {
      const tile = document.querySelector<HTMLCanvasElement>("canvas.leaflet-tile-loaded");
      const data = tile?.getContext("2d")?.getImageData(0, 0, 1, 1).data;
      return data === undefined ? null : [...data.slice(0, 3)];
    });
  await until(async () => expect(await colour()).toEqual([...kArchiveColour]), 30_000);
  expect(await screen.text(".leaflet-control-attribution")).toContain("Test survey");
});

test("no request left this machine, and nothing was complained of but the bridge's short absence", () => {
  expect(
    screen.complaints.filter((text) => !/WebSocket connection|ERR_CONNECTION_REFUSED/.test(text)),
  ).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
