/** Every panel in every size and theme: nothing is cut off, nobody is kept out, and there is a picture to look at. */
import { afterAll, beforeAll, expect, onTestFailed, test, vi } from "vitest";
import { Screen } from "./screen";
import { Station } from "./station";

const kSizes = [
  [1280, 720],
  [1920, 1080],
] as const;
const kThemes = ["dark", "light"] as const;

const station = new Station({ scenario: "panels.json" });
let screen: Screen;

beforeAll(async () => {
  station.start();
  await station.answers();
  screen = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  await station.stopAll();
});

/** Names of the tabs of a list, or of the buttons of the rail. */
const namesOf = (selector: string) => screen.page.locator(selector).allInnerTexts();

/** What sticks out of the window, or out of a panel that doesn't scroll sideways. */
function overflow(): Promise<string[]> {
  return screen.page.evaluate(() => {
    const root = document.documentElement;
    const out = root.scrollWidth > innerWidth || root.scrollHeight > innerHeight ? ["page"] : [];
    for (const body of document.querySelectorAll(".drawer-body, .side-body, .top-bar, .rail")) {
      if (body.scrollWidth > body.clientWidth) out.push(body.className);
    }
    return out;
  });
}

async function lookAt(name: string): Promise<void> {
  onTestFailed(() => {
    process.stderr.write(`${station.log()}\n`);
  });
  for (const theme of kThemes) {
    for (const [width, height] of kSizes) {
      await screen.picture(`panel-${name.toLowerCase()}`, width, height, theme);
      expect(await overflow(), `${name} at ${width}x${height}`).toEqual([]);
    }
    expect(await screen.barriers(), `${name}, ${theme}`).toEqual([]);
  }
}

test("the fleet is there, with a warning and a lost link", async () => {
  await vi.waitFor(
    async () => {
      expect(await screen.text(".pill")).toBe("Live");
      expect(await screen.text(".summary")).toContain("warning");
      expect(await screen.text(".summary")).toContain("link lost");
    },
    { timeout: 30_000, interval: 100 },
  );
});

const kDrawer = ["Formation", "Plan", "Payload", "Simulation", "Recordings"];
const kTabs = ["Alarms", "Events", "Table", "Charts"];

test.each(kDrawer)("the drawer: %s", async (name) => {
  await screen.button(name).click();
  await screen.page.locator(".drawer", { hasText: name }).waitFor();
  await lookAt(name);
  await screen.page.getByRole("button", { name: `Close ${name}` }).click();
});

test.each(kTabs)("the tab: %s", async (name) => {
  await screen.page.getByRole("tab", { name, exact: true }).click();
  await lookAt(name);
});

test("no panel was left out", async () => {
  expect(await namesOf(".rail-button")).toEqual(kDrawer);
  expect(await namesOf("[role=tab]")).toEqual(kTabs);
});

test("settings and help", async () => {
  await screen.button("Settings").click();
  await lookAt("Settings");
  await screen.page.keyboard.press("Escape");
  await screen.button("Keyboard help").click();
  await screen.page.locator("dialog.help[open]").waitFor();
  await lookAt("Help");
  await screen.page.keyboard.press("Escape");
  await screen.page.locator("dialog.help[open]").waitFor({ state: "hidden" });
});

test("in feet, what the station says is in feet, too", async () => {
  const unit = async (quantity: string, name: string) => {
    await screen.button("Settings").click();
    const choice = screen.page.getByRole("radiogroup", { name: quantity });
    await choice.getByRole("radio", { name, exact: true }).check({ force: true });
    await screen.page.keyboard.press("Escape");
  };
  const mode = () => screen.page.locator(".mode-card", { hasText: "link of" }).first().innerText();
  expect(await mode()).toMatch(/200 m\b/);
  await unit("Altitude", "ft");
  expect(await mode()).toMatch(/656 ft\b/);
  await unit("Altitude", "m");
});

test("on a tablet, upright or not, nothing is out of reach", async () => {
  for (const [width, height] of [
    [1180, 820],
    [820, 1180],
  ] as const) {
    await screen.picture("tablet", width, height, "light");
    expect(await overflow()).toEqual([]);
  }
  // There is no room for both: alarms come before tools.
  await screen.button("Plan").click();
  await screen.page.locator(".drawer").waitFor();
  await screen.picture("tablet-plan", 820, 1180, "light");
  await screen.page.locator(".badges").click();
  await screen.page.locator(".alarms").waitFor();
});

test("panels that were drawn as large as on a large screen leave room for the map on a small one", async () => {
  const { page } = screen;
  await screen.resize(1280, 720);
  const draw = async (label: string, dx: number, dy: number) => {
    const box = await page.getByRole("separator", { name: label }).boundingBox();
    if (box === null) throw new Error(`no ${label}`);
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + dx, y + dy);
    await page.mouse.up();
  };
  if ((await page.locator(".drawer").count()) === 0) await screen.button("Plan").click();
  await draw("Width of Plan", 600, 0);
  await draw("Width of the column", -500, 0);
  await draw("Height of the dock", 0, -700);
  await screen.picture("panels-at-their-largest", 1280, 720, "dark");
  expect(await overflow()).toEqual([]);
  const map = await page.locator(".map").boundingBox();
  expect(map?.width).toBeGreaterThanOrEqual(240);
  expect(map?.height).toBeGreaterThanOrEqual(120);
  const help = await screen.button("Keyboard help").boundingBox();
  expect((help?.x ?? Infinity) + (help?.width ?? 0)).toBeLessThanOrEqual(1280);
});

test("nothing was complained of, and no request left this machine", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
