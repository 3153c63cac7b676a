/** Recordings where no fleet flies: a folder of them with a flight in two parts, then one file by itself. */
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Logger } from "./logger";
import { Screen, until } from "./screen";
import { explain, kBin, kPageUrl, Station } from "./station";
import { TimeLine } from "./time_line";

const kFolder = mkdtempSync(`${tmpdir()}/skein-alone-`);
const kWhole = `${kFolder}/whole.log`;
const kParts = "Roles-20261127-120000.lcm";
const kNote = "Gusts from here on";
const kSplit_s = 4;

const live = new Station({ scenario: "roles.json" });
const folder = new Station({ scenario: "roles.json", bridge: ["--logs", kFolder, "--no-bus"] });
const alone = new Station({ scenario: "roles.json", bridge: ["--log", kWhole] });
let screen: Screen;
let time_line: TimeLine;
const page = () => screen.page;

/** The recording is open and its length known. */
const opened = () => until(async () => expect(await time_line.duration_s()).toBeGreaterThan(kSplit_s));

beforeAll(async () => {
  const logger = new Logger(kWhole);
  live.start();
  live.start("flight-recorder"); // it is who writes markers
  await live.answers();
  screen = await Screen.open();
  time_line = new TimeLine(screen);
  await screen.row(1).waitFor();
  await until(async () => expect(await screen.text(".recording-pill")).toContain("Rec"));
  logger.start();
  await until(() => expect(logger.bytes()).toBeGreaterThan(0));
  await screen.flies(2 * kSplit_s);
  await page().keyboard.press("k");
  await page().getByLabel("Marker", { exact: true }).fill(kNote);
  await page().keyboard.press("Enter");
  await page().getByText(`Put: ${kNote}`).waitFor();
  await page().keyboard.press("Escape");
  await screen.flies(2);
  await logger.stop();
  await live.stopAll();
  const skein = (...args: string[]) => execFileSync(`${kBin}/skein`, args, { encoding: "utf8" });
  const cut = (to: string, ...range: string[]) =>
    skein("log", "cut", kWhole, ...range, "--out", `${kFolder}/${to}`);
  cut(kParts, "--to", String(kSplit_s));
  cut(`${kParts}.01`, "--from", String(kSplit_s));
}, 90_000);

afterAll(async () => {
  await screen?.close();
  await Promise.all([live, folder, alone].map((station) => station.stopAll()));
  rmSync(kFolder, { recursive: true, force: true });
});

test("with a folder and no bus, the page begins with the list", async () => {
  explain(folder);
  folder.start("web-bridge");
  await folder.answers();
  await page().goto(kPageUrl);
  const entry = page().locator(".recording", { hasText: kParts });
  await until(async () => expect(await entry.innerText()).toMatch(/2 UAVs[^]*1 marker/));
  // The whole is one as well: a log is known by what it begins with.
  expect(await page().locator(".recording").count()).toBe(2);
  expect(await screen.text(".pill")).toBe("No recording open");
  expect(await screen.text(".alarms .empty")).toBe("Open a recording to see its alarms.");
  for (const theme of ["dark", "light"] as const) {
    await screen.picture("recordings-alone", 1280, 720, theme);
    expect(await screen.barriers()).toEqual([]);
  }
  await page()
    .getByRole("link", { name: `Open ${kParts}`, exact: true })
    .last()
    .click();
});

test("a recording in two parts is one flight", async () => {
  explain(folder);
  await opened();
  await time_line.goTo(String(kSplit_s - 1));
  await until(async () => expect(await page().locator("tbody tr").count()).toBe(2));
  await page().keyboard.press("Space");
  await until(async () => expect(await time_line.at_s()).toBeGreaterThan(kSplit_s + 0.2));
  await page().keyboard.press("Space");
  expect(await page().locator("tbody tr").count()).toBe(2);
});

test("a marker has a flag that tells what was written, and is jumped to", async () => {
  explain(folder);
  const response = await fetch(`${kPageUrl}api/recordings/${kParts}`);
  const { marks, duration_s } = (await response.json()) as {
    marks: { kind: string; t_s: number }[];
    duration_s: number;
  };
  const marked_s = marks.find(({ kind }) => kind === "marker")?.t_s ?? NaN;
  expect(marked_s).toBeGreaterThan(kSplit_s);
  const place = await time_line.placeOf(marked_s / duration_s);
  await page().mouse.move(place.x, place.y);
  const tip = page().locator(".track-tip");
  await until(async () => expect(await tip.innerText()).toContain(kNote));
  expect(await tip.locator(".marker-flag").count()).toBe(1);
  await screen.picture("recording-marker", 1280, 720, "dark");
  await time_line.goTo("0");
  await until(async () => expect(await time_line.at_s()).toBe(0));
  await page().keyboard.press("Control+ArrowRight");
  await until(async () => expect(Math.abs((await time_line.at_s()) - marked_s)).toBeLessThan(0.2));
});

test("one file by itself is opened at once", async () => {
  explain(alone);
  await folder.stopAll();
  alone.start("web-bridge");
  await alone.answers();
  await page().goto(kPageUrl);
  await page().locator(".playhead").waitFor();
  await opened();
  expect(await screen.text(".replay-banner")).toContain("whole.log");
  await time_line.goTo("2");
  await until(async () => expect(await page().locator("tbody tr").count()).toBe(2));
  await screen.picture("recording-by-itself", 1280, 720, "light");
});

test("nothing was complained of but the absence of a bridge, and no request left this machine", () => {
  const of_absence = /WebSocket connection|ERR_CONNECTION_REFUSED/;
  expect(screen.complaints.filter((text) => !of_absence.test(text))).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
