/** The map: threats, trails, tools and layers, as a person at the page sees them. */
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until, type Centre } from "./screen";
import { explain, Station } from "./station";

const station = new Station({ scenario: "map.json" });
let screen: Screen;

beforeAll(async () => {
  station.start("web-bridge");
  await station.answers();
  screen = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  await station.stopAll();
});

/** How many pixels of a canvas of the map have a colour of the stylesheet; all that are drawn at all when none is named. */
const pixels = async (canvas: "fleet" | "ground", token?: string) =>
  (await screen.ink(`canvas.${canvas}`, token, 7)).reduce((sum, tenth) => sum + tenth, 0);

const menu = () => screen.button("Layers of the map");
const layer = (label: string) => screen.page.getByLabel(label, { exact: true });

async function bounds(): Promise<{
  x: number;
  y: number;
  width: number;
  height: number;
}> {
  const box = await screen.page.locator(".free").boundingBox();
  if (box === null) throw new Error("no map");
  return box;
}

test("a threat is amber, then red, with lines to the closest point of approach", async () => {
  explain(station);
  // The page first: it must not miss the beginning.
  station.start("fleet-simulator", "formation-controller", "collision-monitor");
  await until(async () => expect(await screen.row(2).count()).toBe(1), 30_000);
  // UAV1, 1 km farther from the stranger, is warned some seconds later: looked at before UAV2 each time.
  let other = "";
  await until(async () => {
    other = (await screen.uav(1)).level;
    expect((await screen.uav(2)).level).toBe("Caution");
  }, 30_000);
  expect(other).toBe("Clear");
  await screen.page.keyboard.press("f");
  await until(async () => expect(await pixels("fleet", "caution")).toBeGreaterThan(400));
  await menu().click();
  const with_lines = await pixels("fleet", "caution");
  await layer("Closest points of threats").uncheck();
  await until(async () => expect(await pixels("fleet", "caution")).toBeLessThan(with_lines - 20));
  await layer("Closest points of threats").check();
  await screen.page.keyboard.press("Escape");
  await until(async () => expect((await screen.uav(2)).level).toBe("Warning"), 30_000);
  await until(async () => expect(await pixels("fleet", "warning")).toBeGreaterThan(400));
  await screen.page.screenshot({
    path: `${import.meta.dirname}/test-results/map-warning.png`,
  });
});

test("trails are of all, of the selected or of nobody", async () => {
  explain(station);
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
  explain(station);
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

/** Where a UAV is on the screen; there must be one. */
async function uavAt(id: number): Promise<Centre> {
  let at: Centre | null = null;
  await until(async () => expect((at = await screen.symbol(id))).not.toBeNull());
  return at ?? { x: 0, y: 0 };
}

const apart = (a: Centre, b: Centre) => Math.hypot(a.x - b.x, a.y - b.y);

/** Fits the fleet into the map and waits until the map has come to rest; a click before would miss, and a second one zoom. */
async function fit(): Promise<void> {
  await screen.page.keyboard.press("f");
  await screen.nextFrames();
  let before = await uavAt(1);
  await until(async () => {
    const [at, moved_from] = [await uavAt(1), before];
    before = at;
    expect(apart(at, moved_from)).toBeLessThan(3);
  });
}

test("Enter in the table brings a UAV into the middle of what no panel covers", async () => {
  explain(station);
  await screen.page.keyboard.press("f");
  await screen.page.keyboard.press("t");
  const grid = screen.page.getByRole("grid");
  await until(async () =>
    expect(await grid.evaluate((table) => table === document.activeElement)).toBe(true),
  );
  await screen.page.keyboard.press("End");
  await screen.page.keyboard.press("Enter");
  const box = await screen.page.locator(".in-sight").boundingBox();
  if (box === null) throw new Error("no map");
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await until(async () => {
    const active = await grid.getAttribute("aria-activedescendant");
    const at = await uavAt(Number(active?.replace(/\D/g, "")));
    // It flies on meanwhile.
    expect(apart(at, middle)).toBeLessThan(30);
  });
  await screen.page.locator(".map").focus();
});

test("one finger pans the map, two zoom it", async () => {
  explain(station);
  await screen.page.keyboard.press("Escape");
  // From further away, where they hardly move while a finger does.
  const close = apart(await uavAt(1), await uavAt(2));
  for (let i = 0; i < 4; i += 1) await screen.page.keyboard.press("-");
  await until(async () => expect(apart(await uavAt(1), await uavAt(2))).toBeLessThan(0.4 * close));
  const free = await bounds();
  const from = { x: free.x + free.width * 0.4, y: free.y + free.height * 0.3 };
  const path = (dx: number, dy: number) =>
    [0, 0.25, 0.5, 0.75, 1].map((part) => ({
      x: from.x + part * dx,
      y: from.y + part * dy,
    }));

  // A finger that rests before it is lifted doesn't throw the map.
  const kRest_ms = 150;
  const before = await uavAt(1);
  await screen.touch(
    path(-60, 40).map((finger) => [finger]),
    kRest_ms,
  );
  await until(async () => {
    const at = await uavAt(1);
    expect(Math.abs(at.x - before.x + 60)).toBeLessThan(20);
    expect(Math.abs(at.y - before.y - 40)).toBeLessThan(20);
  });

  const near = apart(await uavAt(1), await uavAt(2));
  const [left, right] = [path(-60, 0), path(60, 0)];
  await screen.touch(left.map((finger, i) => [{ x: finger.x - 40, y: finger.y }, right[i] ?? finger]));
  await until(async () => expect(apart(await uavAt(1), await uavAt(2))).toBeGreaterThan(1.3 * near));
});

test("a tap selects a UAV, a tap beside it none", async () => {
  explain(station);
  await fit();
  const tap = async (id: number, beside_px = 0) => {
    const { x, y } = await uavAt(id);
    await screen.touch([[{ x: x + beside_px, y }]]);
  };
  for (const id of [1, 2]) {
    await tap(id);
    await until(async () => {
      expect(await screen.row(id).getAttribute("aria-selected")).toBe("true");
      expect(await screen.text(".selected-count")).toBe("1 selected");
    });
  }
  // Where none of the others is; and they have flown on, out of the map's free part in time.
  await fit();
  const [at, ...others] = [await uavAt(1), await uavAt(2), await uavAt(3)];
  const free_px = (beside_px: number) =>
    Math.min(...others.map((other) => apart({ x: at.x + beside_px, y: at.y }, other)));
  await tap(
    1,
    [-100, -70, 70, 100].reduce((best, beside_px) => (free_px(beside_px) > free_px(best) ? beside_px : best)),
  );
  await until(async () => expect(await screen.text(".selected-count")).toBe("None selected"));
});

test("the other mouse button, or a long press, adds to the selection and takes out", async () => {
  explain(station);
  await fit();
  const press = async (id: number, button: "left" | "right") => {
    const { x, y } = await uavAt(id);
    await screen.page.mouse.click(x, y, { button });
  };
  const selected = (text: string) =>
    until(async () => expect(await screen.text(".selected-count")).toBe(text));
  await press(1, "left");
  await selected("1 selected");
  await press(2, "right");
  await selected("2 selected");
  await press(1, "right");
  await selected("1 selected");
  await screen.page.keyboard.press("Escape");
  await selected("None selected");
});

test("measuring tells length and bearing of each leg, by mouse and by keyboard", async () => {
  explain(station);
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
  explain(station);
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

test("who is lost becomes a ghost: an outline, not filled any more", async () => {
  explain(station);
  await uavAt(1);
  await screen.button("Cut the link of UAV1").click();
  await until(async () => expect((await screen.uav(1)).downlink).toBe("lost"), 20_000);
  await until(async () => expect(await screen.symbol(1)).toBeNull());
  expect(await pixels("fleet", "identity-1")).toBeGreaterThan(50);
  await screen.page.screenshot({ path: `${import.meta.dirname}/test-results/map-ghost.png` });
});

test("no request left this machine, and nothing was complained of", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
