/** A person at the formation editor: changes a formation, sees what it would do, applies it, lets it hold and fly on. One flight. */
import { afterAll, beforeAll, expect, test, vi } from "vitest";
import { Screen } from "./screen";
import { explain, Station } from "./station";

const station = new Station({ scenario: "formation.json" });
let screen: Screen;

const until = (what: () => Promise<void> | void, timeout: number) =>
  vi.waitFor(what, { timeout, interval: 100 });
const kCanvas = ".slot-canvas canvas";
const apply = () => screen.button("Apply the formation");
const flown = () => screen.text(".flown");
const draftState = () => screen.text(".draft-state");

/** Tests build on one another: what the nodes said tells why one failed. */
async function choose(shape: string): Promise<void> {
  // The radio buttons lie unseen over their pictures.
  await screen.page.getByRole("radio", { name: shape, exact: true }).check({ force: true });
}

async function type(label: string, value: string): Promise<void> {
  await screen.page.getByLabel(label, { exact: true }).fill(value);
  await screen.page.keyboard.press("Enter");
}

/** Flown ahead, with figures. */
async function previewed(): Promise<string> {
  await screen.page.locator(".figures .least").waitFor({ timeout: 30_000 });
  return screen.text(".figures");
}

/** In the middle of a slot's disc, on the page. */
async function slotAt(id: number): Promise<{ x: number; y: number }> {
  const seen = await screen.atRest(() => screen.symbol(id, kCanvas));
  if (seen === null) throw new Error(`the slot of UAV${id} is not to be seen`);
  return seen;
}

/** How far a UAV is from its slot, as the list of places says. */
async function way_m(id: number): Promise<number> {
  const row = screen.page.locator(`.slot-table tr:has(input[title="Forward of UAV${id}"])`);
  return Number(await row.locator("td.value").last().innerText());
}

async function command(channel: string, body: unknown): Promise<void> {
  const response = await fetch(new URL("api/command", screen.page.url()), {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ channel, body }),
  });
  expect(await response.json()).toMatchObject({ accepted: true });
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

test("the editor opens by key and shows the formation as it is flown", async () => {
  explain(station);
  await until(async () => expect(await screen.text(".mode-name")).toBe("In formation"), 20_000);
  await screen.page.keyboard.press("e");
  await until(
    async () => expect(await flown()).toBe("Flown: Triangle of 3, 500 m apart, control skein"),
    10_000,
  );
  expect(await draftState()).toBe("This is what is flown.");
  expect(await apply().isDisabled()).toBe(true);
});

test("another shape and spacing are flown ahead before they can be applied", async () => {
  explain(station);
  await choose("Vee");
  await type("Spacing [m]", "400");
  expect(await draftState()).toContain("Differs from what is flown: shape, spacing, 2 places");
  expect(await previewed()).toMatch(
    /Least distance\s+R \d+ m, H \d+ m\s+UAV\d and UAV\d, \+\d+ s\s+Settles\s+in \d+ s/,
  );
  await until(async () => expect(await apply().isEnabled()).toBe(true), 2000);
  await screen.page.getByLabel("Time that is shown on the map").fill("20");
  await screen.picture("formation-preview", 1280, 720, "dark");
  await screen.picture("formation-preview", 1920, 1080, "light");
  await screen.resize(1280, 720);
});

test("a slot dragged into another's cylinder is named, and Apply is blocked until that is overridden", async () => {
  explain(station);
  const [from, to] = [await slotAt(2), await slotAt(3)];
  await screen.page.mouse.move(from.x, from.y);
  await screen.page.mouse.down();
  await screen.page.mouse.move(to.x - 30, to.y, { steps: 8 });
  await screen.page.mouse.up();
  await until(
    async () => expect(await screen.text(".risk")).toContain("The slots of UAV2 and UAV3 lie inside"),
    2000,
  );
  // What is selected on the canvas is selected everywhere.
  expect(await screen.text(".dock-body")).toContain("1 selected");
  expect(await apply().isDisabled()).toBe(true);
  await previewed();
  expect(await apply().isDisabled()).toBe(true);
  await screen.picture("formation-conflict", 1280, 720, "dark");
  await screen.picture("formation-conflict", 1920, 1080, "light");
  await screen.resize(1280, 720);
  const override = screen.page.getByRole("checkbox", { name: "Apply all the same" });
  await override.check();
  expect(await apply().isEnabled()).toBe(true);

  // Another edit takes the override back.
  await screen.page.locator(kCanvas).focus();
  await screen.page.keyboard.press("ArrowUp");
  await until(async () => expect(await override.isChecked()).toBe(false), 2000);
  expect(await apply().isDisabled()).toBe(true);
});

test("undo takes back the keys and the drag, each as one step", async () => {
  explain(station);
  await screen.page.keyboard.press("Control+z");
  await screen.page.keyboard.press("Control+z");
  await until(async () => expect(await draftState()).toContain("shape, spacing, 2 places"), 2000);
  expect(await screen.page.locator(".risk").count()).toBe(0);
  expect(await screen.page.getByRole("radio", { name: "Vee" }).isChecked()).toBe(true);
});

test("who flies where is exchanged by hand, and proposed again", async () => {
  explain(station);
  const places = () => screen.page.locator(".slot-table tbody tr th").allInnerTexts();
  const before = (await places()).map((text) => text.slice(0, 1));
  await screen.page.getByLabel("Who flies in the slot of UAV2").selectOption("1");
  await until(async () => expect(await draftState()).toContain("3 places"), 2000);
  await screen.button("Propose").click();
  await until(async () => {
    expect((await places()).map((text) => text.slice(0, 1))).toEqual(before);
  }, 5000);
});

test("Apply is answered, and the fleet flies what was applied", async () => {
  explain(station);
  await previewed();
  await until(async () => expect(await apply().isEnabled()).toBe(true), 5000);
  await apply().click();
  await until(async () => expect(await flown()).toBe("Flown: Vee of 3, 400 m apart, control skein"), 5000);
  await until(async () => expect(await draftState()).toBe("Accepted, and flown as applied."), 2000);
  await until(async () => {
    expect(await screen.text(".mode-of")).toContain("vee");
    // 152 m from the slot of the triangle to that of the vee.
    expect(await way_m(2)).toBeLessThan(100);
  }, 60_000);
});

test("what another operator changes meanwhile is pointed out, and the draft is kept", async () => {
  explain(station);
  await type("Spacing [m]", "450");
  const { formations } = (await (await fetch(new URL("api/state", screen.page.url()))).json()) as {
    formations: { radius_m: number }[];
  };
  await command("CMD_FORMATION", {
    action: "apply",
    formation: { ...formations[0], radius_m: 200, d_mod_m: 200 },
  });
  const notice = screen.page.locator(".formation-notice");
  await until(async () => expect(await notice.innerText()).toContain("cylinder, thresholds"), 5000);
  expect(await screen.page.getByLabel("Spacing [m]", { exact: true }).inputValue()).toBe("450");
  await screen.button("Take what is flown").click();
  await until(async () => expect(await draftState()).toBe("This is what is flown."), 2000);
});

test("a new formation is made of what is selected", async () => {
  explain(station);
  await screen.show(1280, 720, "dark");
  await until(async () => {
    const seen = await screen.symbol(4);
    if (seen === null) throw new Error("UAV4 is not on the map");
    await screen.page.mouse.click(seen.x, seen.y);
    expect(await screen.button("New").isEnabled()).toBe(true);
  }, 10_000);
  await screen.button("New").click();
  await until(async () => expect(await draftState()).toContain("Not flown yet"), 2000);
  await until(async () => expect(await apply().isEnabled()).toBe(true), 30_000);
  await apply().click();
  await until(async () => expect(await flown()).toContain("Flown: Triangle of 1"), 5000);
});

test("one key lets all hold, and two let them fly on", async () => {
  explain(station);
  await screen.page.evaluate(() => {
    (document.activeElement as HTMLElement | null)?.blur();
  });
  await screen.page.keyboard.press("h");
  const modes = () => screen.page.locator(".mode-name").allInnerTexts();
  await until(async () => expect(await modes()).toEqual(["Holding", "Holding"]), 10_000);
  expect(await screen.text(".hold-all")).toBe("Holding");
  await screen.picture("formation-holding", 1280, 720, "light");
  await screen.page.keyboard.press("Shift+H");
  await until(async () => expect(await modes()).not.toContain("Holding"), 10_000);
  expect(await screen.text(".hold-all")).toBe("Hold");
});

test("axe finds no barrier in the editor, with all of it open, in either theme", async () => {
  explain(station);
  await choose("Column");
  for (const part of await screen.page.locator(".part summary").all()) await part.click();
  for (const theme of ["dark", "light"] as const) {
    await screen.show(1280, 720, theme);
    expect(await screen.barriers()).toEqual([]);
  }
});

test("nothing was complained of, and no request left this machine", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
