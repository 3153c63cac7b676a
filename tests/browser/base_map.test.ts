/** What lies under the fleet: a folder of tiles, a PMTiles file, a tile server, and the outlines when all of them fail. */
import { mkdtempSync, rmSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until } from "./screen";
import { explain, Station } from "./station";
import { png, writePmtiles, writeTileFolder, writeVectorPmtiles } from "./tiles_for_tests";

const kFolder = mkdtempSync(`${tmpdir()}/skein-tiles-`);
const kFolderColour = [90, 140, 60] as const;
const kArchiveColour = [60, 90, 150] as const;
const kServerColour = [150, 90, 60] as const;

const station = new Station({ scenario: "map.json", bridge: ["--tiles", `${kFolder}/county`] });
const with_archive = new Station({ scenario: "map.json", bridge: ["--tiles", `${kFolder}/area.pmtiles`] });
const with_protomaps = new Station({
  scenario: "map.json",
  bridge: ["--tiles", `${kFolder}/vector.pmtiles`],
});
const with_other_schema = new Station({
  scenario: "map.json",
  bridge: ["--tiles", `${kFolder}/omt.pmtiles`],
});
let screen: Screen;
let tile_server: Server | null = null;

beforeAll(async () => {
  writeTileFolder(`${kFolder}/county`, 40.09, 116.58, kFolderColour);
  writePmtiles(`${kFolder}/area.pmtiles`, kArchiveColour);
  writeVectorPmtiles(`${kFolder}/vector.pmtiles`, "earth", "water", "roads");
  writeVectorPmtiles(`${kFolder}/omt.pmtiles`, "landcover", "water", "transportation");
  station.start();
  await station.answers();
  screen = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  const stations = [station, with_archive, with_protomaps, with_other_schema];
  await Promise.all(stations.map((one) => one.stopAll()));
  tile_server?.close();
  rmSync(kFolder, { recursive: true, force: true });
});

const menu = () => screen.button("Layers of the map");
const layer = (label: string) => screen.page.getByLabel(label, { exact: true });

test("a folder of tiles lies under the fleet, and can be put away", async () => {
  explain(station, with_archive);
  const tiles = screen.page.locator("img.leaflet-tile-loaded");
  await until(async () => expect(await tiles.count()).toBeGreaterThan(0));
  await menu().click();
  expect(await layer("county").isChecked()).toBe(true);
  for (const theme of ["dark", "light"] as const) {
    await screen.page.emulateMedia({ colorScheme: theme });
    expect(await screen.barriers()).toEqual([]);
    await screen.page.screenshot({
      path: `${import.meta.dirname}/test-results/map-layers-${theme}.png`,
    });
  }
  await screen.page.emulateMedia({ colorScheme: "dark" });
  await layer("Offline outlines").check();
  await until(async () => expect(await tiles.count()).toBe(0));
  await layer("county").check();
  await screen.page.keyboard.press("Escape");
});

test("a PMTiles file is read in parts and drawn", async () => {
  explain(station, with_archive);
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

for (const [schema, vectors, before] of [
  ["Protomaps", with_protomaps, with_archive],
  ["another", with_other_schema, with_protomaps],
] as const) {
  test(`vector tiles of ${schema} schema are drawn, in the greys of the theme`, async () => {
    explain(before, vectors);
    await before.stop("web-bridge");
    vectors.start("web-bridge");
    await vectors.answers();
    // In each tile a stripe of water on the left, ground on the right.
    const greys = () =>
      screen.page.evaluate(() => {
        const tile = document.querySelector<HTMLCanvasElement>("canvas.leaflet-tile-loaded");
        // Of a copy: who reads a canvas makes it slow.
        const copy = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
        const at = (x: number) => {
          if (tile === null || copy === null) return -1;
          copy.drawImage(tile, x * tile.width, 5, 1, 1, 0, 0, 1, 1);
          return copy.getImageData(0, 0, 1, 1).data[0] ?? -1;
        };
        return [at(0.25), at(0.75)] as [number, number];
      });
    const seen: number[] = [];
    for (const theme of ["dark", "light"] as const) {
      await screen.page.emulateMedia({ colorScheme: theme });
      await until(async () => {
        const [water, ground] = await greys();
        expect(Math.abs(water - ground)).toBeGreaterThan(20);
        if (theme === "dark") expect(ground).toBeLessThan(100);
        else expect(ground).toBeGreaterThan(150);
      }, 30_000);
      seen.push(...(await greys()));
      await screen.page.screenshot({
        path: `${import.meta.dirname}/test-results/map-vector-${schema}-${theme}.png`,
      });
    }
    expect(new Set(seen).size).toBe(4);
    expect(await screen.text(".leaflet-control-attribution")).toContain("Vector survey");
    await screen.page.emulateMedia({ colorScheme: "dark" });
    // Or the next bridge would be asked for the rest of this map.
    await until(async () => expect((await greys())[1]).toBeLessThan(100));
  });
}

test("tiles of a server come with its attribution; when it dies, that is told, and the outlines are seen again", async () => {
  const serve = (port: number) =>
    new Promise<Server>((resolve) => {
      const server = createServer((_, response) => {
        response.writeHead(200, {
          "Content-Type": "image/png",
          "Cache-Control": "no-store",
        });
        response.end(png(kServerColour));
      }).listen(port, "127.0.0.1", () => {
        resolve(server);
      });
    });
  tile_server = await serve(0);
  const { port } = tile_server.address() as AddressInfo;
  const with_server = new Station({
    scenario: "map.json",
    bridge: [
      ...["--tile-url", `http://127.0.0.1:${port}/{z}/{x}/{y}.png`],
      ...["--tile-attribution", "Survey of the county"],
    ],
  });
  explain(with_server);
  await with_other_schema.stop("web-bridge");
  with_server.start("web-bridge");
  try {
    await with_server.answers();
    // The policy of a page, whose images it may show, comes with the page.
    await screen.page.reload();
    const tiles = screen.page.locator(`img.leaflet-tile-loaded[src^="http://127.0.0.1:${port}/"]`);
    // All at one moment: Leaflet empties the image of a tile that the map has just left.
    const widths_px = () =>
      tiles.evaluateAll((images) => images.map((image) => (image as HTMLImageElement).naturalWidth));
    await until(async () => {
      const seen_px = await widths_px();
      expect(seen_px.length).toBeGreaterThan(3);
      expect(new Set(seen_px)).toEqual(new Set([256]));
    }, 30_000);
    expect(await screen.text(".leaflet-control-attribution")).toContain("Survey of the county");
    await screen.page.screenshot({
      path: `${import.meta.dirname}/test-results/map-tile-server.png`,
    });

    tile_server.closeAllConnections();
    await new Promise((resolve) => tile_server?.close(resolve));
    await menu().click();
    await screen.page.mouse.move(500, 200);
    await screen.page.mouse.wheel(0, -240);
    const problem = screen.page.getByText("none of its tiles has come for this place");
    await problem.waitFor();
    await until(async () => expect(await tiles.count()).toBe(0));
    const land = await screen.ink(".overlay.land", "map-land", 2);
    expect(Math.min(...land)).toBeGreaterThan(1000);
    await screen.page.screenshot({
      path: `${import.meta.dirname}/test-results/map-tile-server-gone.png`,
    });

    tile_server = await serve(port);
    await screen.page.mouse.wheel(0, 240);
    await until(async () => expect(await tiles.count()).toBeGreaterThan(3));
    await until(async () => expect(await problem.count()).toBe(0));
    await screen.page.keyboard.press("Escape");
  } finally {
    await with_server.stopAll();
  }
});

test("no request left this machine, and nothing was complained of but that bridges went, and their maps with them", () => {
  const of_bridges = /WebSocket connection|ERR_CONNECTION_(REFUSED|RESET)|404 \(Not Found\) .*\/tiles[./]/;
  expect(screen.complaints.filter((text) => !of_bridges.test(text))).toEqual([]);
  const tile_url = `http://127.0.0.1:${(tile_server?.address() as AddressInfo).port}/`;
  expect(screen.strangers.filter((url) => !url.startsWith(tile_url))).toEqual([]);
});
