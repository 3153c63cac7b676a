/** A person plans a path: draws it, repairs what can't be flown, keeps it in files, reviews it, sends it, and sees it flown. */
import { readFileSync } from "node:fs";
import { afterAll, beforeAll, expect, onTestFailed, test, vi } from "vitest";
import { Screen } from "./screen";
import { kPageUrl, Station } from "./station";

const kResults = new URL("test-results/", import.meta.url).pathname;
const station = new Station({ scenario: "plan.json" });
let screen: Screen;

const until = (what: () => Promise<void> | void, timeout = 10_000) =>
  vi.waitFor(what, { timeout, interval: 100 });

function explain(): void {
  onTestFailed(async () => {
    process.stderr.write(`${station.log()}\n`);
    await screen.page.screenshot({ path: `${kResults}plan-failed.png` });
  });
}

beforeAll(async () => {
  station.start();
  await station.answers();
  screen = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  await station.stopAll();
});

const field = (name: string) => screen.page.getByRole("textbox", { name });
/** A button of the panel: others have buttons of the same name. */
const tool = (name: string) => screen.page.locator(".plan").getByRole("button", { name, exact: true });
const handle = (number: number) => screen.page.locator(".plan-handle.waypoint").nth(number - 1);
const rows = () => screen.page.locator(".waypoint-row");
const legs = () => screen.page.locator(".leg-row").allInnerTexts();
const panel = () => screen.text(".plan");

async function type(name: string, text: string): Promise<void> {
  await field(name).fill(text);
  await field(name).press("Enter");
}

/** A place in the free middle of the map, in parts of it. */
async function freePlace(right: number, down: number): Promise<[number, number]> {
  const box = await screen.page.locator(".map").boundingBox();
  if (box === null) throw new Error("there is no map");
  return [box.x + right * box.width, box.y + down * box.height];
}

async function middleOf(number: number): Promise<[number, number]> {
  const box = await handle(number).boundingBox();
  if (box === null) throw new Error(`waypoint ${number} is not on the map`);
  return [box.x + box.width / 2, box.y + box.height / 2];
}

/** The same once the map has come to rest: what is grabbed must still be there. */
const restOf = (number: number) => screen.atRest(() => middleOf(number));

/** A picture with the whole path on the map. */
async function look(name: string, width: number, height: number, theme: "dark" | "light"): Promise<void> {
  await screen.resize(width, height);
  await screen.page.emulateMedia({ colorScheme: theme });
  const fit = tool("Fit");
  if (await fit.isVisible()) await fit.click();
  await screen.page.screenshot({ path: `${kResults}plan-${name}-${width}x${height}-${theme}.png` });
}

interface Told {
  paths: { path_revision: number; closed: boolean; waypoints: Record<string, number>[] }[];
  statuses: { leader_course_rad: number }[];
}
const told = async () => (await (await fetch(`${kPageUrl}api/state`)).json()) as Told;

test("the plan of a formation without a path is empty, and says how to begin", async () => {
  explain();
  await until(async () => expect(await screen.text(".pill")).toBe("Live"), 20_000);
  await screen.page.locator(".mode-card").waitFor();
  await screen.page.keyboard.press("p");
  await until(async () => expect(await panel()).toContain("Straight on."));
  await screen.picture("plan-empty", 1280, 720, "dark");
  // Far enough out for legs of some kilometres.
  for (let i = 0; i < 5; i += 1) await screen.button("Zoom out").click();
});

test("three clicks are three waypoints, and the arcs between them are shown as they will be flown", async () => {
  explain();
  await screen.page.keyboard.press("w");
  for (const [right, down] of [
    [0.5, 0.3],
    [0.75, 0.3],
    [0.75, 0.75],
  ] as const) {
    await screen.page.mouse.click(...(await freePlace(right, down)));
  }
  await screen.page.keyboard.press("Escape");
  await until(async () => expect(await rows().count()).toBe(3));
  // From the leader to the first waypoint, and two legs.
  await until(async () => expect(await legs()).toHaveLength(3));
  expect((await legs())[1]).toMatch(/\d+ m\s+09\d°\s+0:0\d:\d\d/);
  await until(async () => expect(await panel()).toMatch(/Least separation R \d+ m, H \d+ m/));
  await look("drawn", 1280, 720, "dark");
});

test("a waypoint is dragged, one inserted, one deleted; every step is undone and done again", async () => {
  explain();
  const at = await restOf(3);
  await screen.page.mouse.move(...at);
  await screen.page.mouse.down();
  await screen.page.mouse.move(at[0] - 60, at[1] + 15, { steps: 4 });
  await screen.page.mouse.up();
  await until(async () => {
    const [x, y] = await middleOf(3);
    expect(Math.hypot(x - at[0] + 60, y - at[1] - 15)).toBeLessThan(3);
  });

  await screen.button("Insert a waypoint between 2 and 3").click();
  await until(async () => expect(await rows().count()).toBe(4));
  await screen.page.keyboard.press("Delete");
  await until(async () => expect(await rows().count()).toBe(3));

  await screen.page.keyboard.press("Control+z");
  await until(async () => expect(await rows().count()).toBe(4));
  await screen.page.keyboard.press("Control+z");
  await screen.page.keyboard.press("Control+z");
  await until(async () => {
    const [x, y] = await middleOf(3);
    expect(Math.hypot(x - at[0], y - at[1])).toBeLessThan(2);
  });
  for (let i = 0; i < 3; i += 1) await screen.page.keyboard.press("Control+Shift+z");
  await until(async () => {
    expect(await rows().count()).toBe(3);
    expect(Math.abs((await middleOf(3))[0] - at[0] + 60)).toBeLessThan(3);
  });
});

test("altitude and speed are typed; what can't be typed is told where it is typed", async () => {
  explain();
  await field("Altitude of waypoint 2").fill("high");
  expect(await screen.page.locator(".field-problem").innerText()).toMatch(
    /^Not a number: -1000 to 20000 m\.$/,
  );
  await field("Altitude of waypoint 2").press("Escape");
  await type("Speed at waypoint 2", "55");
  await screen.page.locator("summary", { hasText: "Whole path" }).click();
  await type("Altitude of all waypoints", "1100");
  expect(await field("Altitude of waypoint 3").inputValue()).toBe("1100");
  expect(await field("Speed at waypoint 2").inputValue()).toBe("55");
  await screen.page.locator("summary", { hasText: "Whole path" }).click();
});

test("a climb that is too steep is shown at its waypoint, and blocks sending until it is put right", async () => {
  explain();
  await type("Altitude of waypoint 3", "4000");
  await until(async () => {
    expect(await screen.page.locator(".problem-row").allInnerTexts()).not.toEqual([]);
    expect(await screen.page.locator(".plan-handle.problem").count()).toBeGreaterThan(0);
  });
  expect(await screen.page.locator(".problem-row").first().innerText()).toMatch(/climb/);
  await look("impossible", 1280, 720, "light");
  await tool("Review…").click();
  await screen.page.getByText("It can't be flown like this.").waitFor();
  expect(await screen.button("Send to Alpha").isDisabled()).toBe(true);
  await look("review-impossible", 1280, 720, "dark");
  await screen.button("Back to planning").click();
  await screen.page.keyboard.press("Control+z");
  await until(async () => expect(await screen.page.locator(".problem-row").count()).toBe(0));
});

test("reviewed and sent, it is read back from the bus as it was sent, and the leader turns onto it", async () => {
  explain();
  const before = await told();
  await tool("Review…").click();
  const review = () => screen.text(".plan-review");
  await until(async () => {
    expect(await review()).toContain("A new path of 3 waypoints.");
    expect(await review()).toMatch(/Least separation/);
    expect(await screen.button("Send to Alpha").isEnabled()).toBe(true);
  });
  await look("review", 1280, 720, "light");
  await screen.button("Send to Alpha").click();
  await until(async () => expect(await review()).toContain("Flown as reviewed"));
  await look("flown", 1920, 1080, "dark");
  await tool("Done").click();
  expect(await tool("Review…").isDisabled()).toBe(true);

  const after = await told();
  const [path] = after.paths;
  expect(path?.path_revision).toBeGreaterThan(before.paths[0]?.path_revision ?? 0);
  expect(path?.waypoints.map(({ up_m }) => up_m)).toEqual([1100, 1100, 1100]);
  expect(path?.waypoints[1]?.["speed_m_s"]).toBe(55);
  const course = before.statuses[0]?.leader_course_rad ?? NaN;
  await until(async () => {
    const now = (await told()).statuses[0]?.leader_course_rad ?? NaN;
    expect(Math.abs(now - course)).toBeGreaterThan(0.1);
  }, 30_000);
});

test.each([
  ["GeoJSON", "geojson"],
  ["KML", "kml"],
  ["QGroundControl", "plan"],
])("saved as %s and opened again it is the path that is flown", async (name, extension) => {
  explain();
  const summary = screen.page.locator("summary", { hasText: "Files" });
  if (!(await screen.button(name).isVisible())) await summary.click();
  const [saved] = await Promise.all([screen.page.waitForEvent("download"), screen.button(name).click()]);
  expect(saved.suggestedFilename()).toBe(`Alpha.${extension}`);
  const buffer = readFileSync(await saved.path());
  await tool("Clear").click();
  await until(async () => expect(await rows().count()).toBe(0));
  const picker = screen.page.getByLabel("File with a path");
  await picker.setInputFiles({ name: saved.suggestedFilename(), mimeType: "", buffer });
  await until(async () => {
    expect(await rows().count()).toBe(3);
    expect(await screen.text(".plan-note")).toContain("is on the map as a draft.");
    // Nothing differs from what is flown.
    expect(await tool("Review…").isDisabled()).toBe(true);
  });
});

test("a file for another place is refused with its distance", async () => {
  explain();
  const far = { type: "LineString", coordinates: [[116.58, 40.08, 900]] };
  await screen.page.getByLabel("File with a path").setInputFiles({
    name: "beijing.geojson",
    mimeType: "",
    buffer: Buffer.from(JSON.stringify(far)),
  });
  await until(async () =>
    expect(await screen.text(".plan-note")).toMatch(/lies \d+ km from the fleet's origin/),
  );
  await tool("Dismiss").click();
});

test("another path of another operator is pointed out, and can be taken", async () => {
  explain();
  await tool("Loop").click();
  const response = await fetch(`${kPageUrl}api/command`, {
    method: "POST",
    body: JSON.stringify({ channel: "CMD_PATH", body: { formation_id: 1, waypoints: [] } }),
  });
  expect(await response.json()).toMatchObject({ accepted: true });
  await until(async () => expect(await panel()).toContain("Alpha flies another path now (straight on)"));
  await look("overtaken", 1280, 720, "dark");
  await screen.button("Take that one").click();
  await until(async () => expect(await rows().count()).toBe(0));
  await screen.page.keyboard.press("Control+z");
  expect(await rows().count()).toBe(3);
});

test("without a mouse a path is built from the keyboard", async () => {
  explain();
  await tool("Clear").press("Enter");
  await tool("Add").press("Enter");
  await type("East of waypoint 1", "2500");
  await type("North of waypoint 1", "9000");
  await screen.button("Select waypoint 1").press("Shift+ArrowRight");
  expect(await field("East of waypoint 1").inputValue()).toBe("2600");
  await handle(1).press("ArrowDown");
  expect(await field("North of waypoint 1").inputValue()).toBe("8990");
  await handle(1).press("Delete");
  await until(async () => expect(await rows().count()).toBe(0));
  await screen.page.keyboard.press("Control+z");
});

test("axe finds no barrier in either theme", async () => {
  explain();
  // Back to a path with everything to see.
  await until(async () => {
    await screen.page.keyboard.press("Control+z");
    expect(await rows().count()).toBe(3);
  });
  for (const theme of ["dark", "light"] as const) {
    await look("editor", 1920, 1080, theme);
    expect(await screen.barriers()).toEqual([]);
  }
});

test("nothing was complained of, and no request left this machine", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
