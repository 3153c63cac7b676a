/** Charts: the flight since its start for a page that comes late, zoom, cursor in step, events, and files to take away. */
import { readFileSync } from "node:fs";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until } from "./screen";
import { explain, kPageUrl, Station } from "./station";

const station = new Station({ scenario: "charts.json" });
let screen: Screen;

/** The flight has lasted so long when the page comes. */
const kLate_s = 6;

interface State {
  vehicles: { id: number; up_m: number | null; payload_on: boolean }[];
  t_s: number;
}
const vehicles = async () => (await fetch(`${kPageUrl}api/vehicles`)).json() as Promise<State>;
const command = (channel: string, body: unknown) =>
  fetch(`${kPageUrl}api/command`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ channel, body }),
  });

/** Samples of one UAV out of GET /api/history, read as cpp/bridge/README.md says. */
async function altitudes(id: number): Promise<Map<number, number>> {
  const view = new DataView(await (await fetch(`${kPageUrl}api/history?ids=${id}`)).arrayBuffer());
  const samples = view.getUint32(16, true);
  return new Map(
    Array.from({ length: samples }, (_, i) => [
      view.getFloat64(24 + 8 * i, true),
      view.getFloat32(24 + 8 * samples + 4 + 4 * i, true),
    ]),
  );
}

const chart = (column: string) => screen.page.locator(`[data-chart="${column}"]`);
const over = (column: string) => chart(column).locator(".u-over");
const cursorTime = () => screen.text(".cursor-time");
/** Labels of the time axis are on a canvas; the cursor's time at both edges tells what is shown [s]. */
async function timeShown(): Promise<[number, number]> {
  const box = await over("up_m").boundingBox();
  if (box === null) throw new Error("the chart isn't there");
  const at = async (x: number) => {
    await screen.page.mouse.move(x, box.y + box.height / 2);
    await screen.page.mouse.move(x, box.y + box.height / 2 + 1);
    const match = /T\+ (\d+):(\d+):(\d+)/.exec(await cursorTime());
    return Number(match?.[1]) * 3600 + Number(match?.[2]) * 60 + Number(match?.[3]);
  };
  return [await at(box.x + 1), await at(box.x + box.width - 2)];
}
/** How many pixels of a UAV's curve a chart has in each tenth of its width. */
const inked = (column: string, id: number) => screen.ink(`[data-chart="${column}"] canvas`, `identity-${id}`);

beforeAll(async () => {
  station.start();
  await station.answers();
  await until(async () => expect((await vehicles()).t_s).toBeGreaterThan(kLate_s - 3), 20_000);
  await command("CMD_PAYLOAD", { vehicle_ids: [2], on: true });
  await until(async () => expect((await vehicles()).t_s).toBeGreaterThan(kLate_s), 20_000);
  screen = await Screen.open();
  await screen.page.evaluate(() => {
    localStorage.setItem("skein.layout.dock_px", "500");
    localStorage.setItem("skein.layout.dock", '"charts"');
  });
  await screen.page.reload();
});

afterAll(async () => {
  await screen?.close();
  await station.stopAll();
});

test("a page that comes late draws the flight since its start, of all UAVs", async () => {
  explain(station);
  await chart("tau_s").waitFor();
  expect(await screen.page.locator(".chart figcaption").allInnerTexts()).toEqual([
    "Altitude m ENU",
    "Speed m/s",
    "Course °",
    "Slot error forward m",
    "Slot error left m",
    "Slot error up m",
    "Nearest, horizontal R m",
    "Nearest, vertical H m",
    "Least Tau s",
  ]);
  expect(await screen.page.locator(".curve-legend li").allInnerTexts()).toEqual([
    "All:",
    "UAV1",
    "UAV2",
    "UAV3",
  ]);
  // The third UAV's curve is drawn last, and reaches from the left of the chart to its right.
  await until(async () => {
    const tenths = await inked("nearest_horizontal_m", 3);
    expect(tenths.filter((count) => count > 0).length).toBeGreaterThanOrEqual(8);
  });
  const [from_s] = await timeShown();
  expect(from_s).toBeLessThanOrEqual(1);
});

test("the values beside a chart are those at the cursor, in step on all charts", async () => {
  explain(station);
  const box = await over("speed_m_s").boundingBox();
  if (box === null) throw new Error("no chart");
  await screen.page.mouse.move(box.x + box.width / 2, box.y + 20);
  await until(async () => {
    const lefts = await screen.page
      .locator(".u-cursor-x")
      .evaluateAll((lines) => lines.map((line) => (line as HTMLElement).style.transform));
    expect(new Set(lefts).size).toBe(1);
    expect(lefts.length).toBe(9);
    expect(await cursorTime()).toMatch(/^T\+ 0:00:\d\d, \d\d:\d\d:\d\d UTC$/);
    expect(await chart("up_m").locator(".chart-values").getAttribute("aria-label")).toBe(
      "Altitude, at the cursor",
    );
    const altitude = Number(await chart("up_m").locator(".chart-value").first().innerText());
    expect(Math.abs(altitude - 1000)).toBeLessThan(5);
  });
});

test("an event is a mark that tells what happened", async () => {
  explain(station);
  const tip = chart("up_m").locator(".chart-tip");
  const box = await over("up_m").boundingBox();
  if (box === null) throw new Error("no chart");
  // There are other marks, too: the cursor goes over all of them.
  const seen = new Set<string>();
  await until(async () => {
    for (let x = 3; x < box.width; x += 6) {
      await screen.page.mouse.move(box.x + x, box.y + 30);
      for (const text of await tip.allInnerTexts()) seen.add(text);
    }
    expect([...seen].join("\n")).toContain("payload of UAV2 is on");
  });
});

test("dragging, the wheel, keys and buttons zoom all charts", async () => {
  explain(station);
  const box = await over("course_rad").boundingBox();
  if (box === null) throw new Error("no chart");
  await screen.page.mouse.move(box.x + box.width * 0.25, box.y + 20);
  await screen.page.mouse.down();
  await screen.page.mouse.move(box.x + box.width * 0.75, box.y + 20, {
    steps: 4,
  });
  await screen.page.mouse.up();
  let closer: [number, number] = [0, 0];
  await until(async () => {
    closer = await timeShown();
    expect(closer[0]).toBeGreaterThanOrEqual(1);
  });
  // Zoomed in, it stands still.
  await screen.flies(2);
  expect(await timeShown()).toEqual(closer);
  await screen.page.mouse.wheel(0, 400);
  await screen.page.mouse.wheel(0, 400);
  await until(async () => {
    const [from_s, to_s] = await timeShown();
    expect(to_s - from_s).toBeGreaterThan(closer[1] - closer[0]);
  });
  const group = screen.page.getByRole("group", { name: /^Charts: plus/ });
  await group.focus();
  await screen.page.keyboard.press("0");
  const all = screen.button("All");
  await until(async () => expect(await all.getAttribute("aria-pressed")).toBe("true"));
  await screen.page.keyboard.press("+");
  await until(async () => expect(await all.getAttribute("aria-pressed")).toBe("false"));
  await all.click();
  await until(async () => expect((await timeShown())[0]).toBeLessThanOrEqual(1));
});

test("a selection is drawn instead, and charts can be left out", async () => {
  explain(station);
  await screen.page.getByRole("tab", { name: "Table" }).click();
  await screen.row(2).locator(".uav-name").click();
  await screen.page.getByRole("tab", { name: "Charts" }).click();
  await until(async () =>
    expect(await screen.page.locator(".curve-legend li").allInnerTexts()).toEqual(["Selected:", "UAV2"]),
  );
  await screen.button("Which charts").click();
  await screen.page.getByRole("checkbox", { name: "Course" }).uncheck();
  await screen.page.keyboard.press("Escape");
  await until(async () => expect(await screen.page.locator(".chart").count()).toBe(8));
});

test("the CSV has what the API has, and the PNG is a picture", async () => {
  explain(station);
  const [csv] = await Promise.all([screen.page.waitForEvent("download"), screen.button("CSV").click()]);
  expect(csv.suggestedFilename()).toMatch(/^skein-\d{8}T\d{6}Z\.csv$/);
  const lines = readFileSync(await csv.path(), "utf8")
    .trim()
    .split("\r\n");
  expect(lines[0]).toBe(
    "utc,t_s,vehicle_id,callsign,up_m,speed_m_s,forward_error_m,left_error_m,up_error_m,nearest_horizontal_m,nearest_vertical_m,tau_s",
  );
  const told = await altitudes(2);
  const compared = lines.slice(1).flatMap((line) => {
    const [, t_s = "", id, callsign, up_m = ""] = line.split(",");
    expect([id, callsign]).toEqual(["2", "UAV2"]);
    const sample = [...told].find(([at_s]) => Math.abs(at_s - Number(t_s)) < 0.001);
    return sample === undefined ? [] : [Math.abs(sample[1] - Number(up_m))];
  });
  expect(compared.length).toBeGreaterThan(kLate_s - 2);
  expect(Math.max(...compared)).toBeLessThan(0.001);

  const [png] = await Promise.all([screen.page.waitForEvent("download"), screen.button("PNG").click()]);
  const bytes = readFileSync(await png.path());
  expect([...bytes.subarray(0, 8)]).toEqual([137, 80, 78, 71, 13, 10, 26, 10]);
  expect(bytes.length).toBeGreaterThan(20_000);
  expect(bytes.readUInt32BE(16)).toBeGreaterThan(600); // width
});

test("axe finds no barrier in either theme", async () => {
  explain(station);
  await screen.picture("charts", 1920, 1080, "dark");
  for (const theme of ["dark", "light"] as const) {
    await screen.picture("charts", 1280, 720, theme);
    expect(await screen.barriers()).toEqual([]);
  }
});

test("nothing was complained of, and no request left this machine", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
