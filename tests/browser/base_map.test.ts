/** What lies under the fleet: a folder of tiles, a PMTiles file, a tile server, and the outlines when all of them fail. */
import { mkdtempSync, rmSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until } from "./screen";
import { explain, Station } from "./station";
import { png, writePmtiles, writeTileFolder } from "./tiles_for_tests";

const kFolder = mkdtempSync(`${tmpdir()}/skein-tiles-`);
const kFolderColour = [90, 140, 60] as const;
const kArchiveColour = [60, 90, 150] as const;
const kServerColour = [150, 90, 60] as const;

const station = new Station({ scenario: "map.json", bridge: ["--tiles", `${kFolder}/county`] });
const with_archive = new Station({ scenario: "map.json", bridge: ["--tiles", `${kFolder}/area.pmtiles`] });
let screen: Screen;
let tile_server: Server | null = null;

beforeAll(async () => {
  writeTileFolder(`${kFolder}/county`, 40.09, 116.58, kFolderColour);
  writePmtiles(`${kFolder}/area.pmtiles`, kArchiveColour);
  station.start();
  await station.answers();
  screen = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  await Promise.all([station.stopAll(), with_archive.stopAll()]);
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
  await with_archive.stop("web-bridge");
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
    const land = await screen.ink(".leaflet-land-pane canvas", "map-land", 2);
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

test("no request left this machine, and nothing was complained of but the bridge's short absence", () => {
  expect(
    screen.complaints.filter((text) => !/WebSocket connection|ERR_CONNECTION_REFUSED/.test(text)),
  ).toEqual([]);
  const tile_url = `http://127.0.0.1:${(tile_server?.address() as AddressInfo).port}/`;
  expect(screen.strangers.filter((url) => !url.startsWith(tile_url))).toEqual([]);
});
