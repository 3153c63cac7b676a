/** The list of recordings: what it tells, opening, taking away, what is damaged or no log at all, and deleting. */
import { appendFileSync, existsSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { afterAll, beforeAll, expect, test } from "vitest";
import { kName, RecordedFlight } from "./recorded_flight";
import { Screen, until } from "./screen";
import { explain, kPageUrl } from "./station";

const kTorn = "Torn-20261125-150000.lcm";
const kNotes = "notes.lcm";

const flight = new RecordedFlight();
let screen: Screen;

const page = () => screen.page;
const entry = (name: string) => page().locator(".recording", { hasText: name });

beforeAll(async () => {
  await flight.start();
});

afterAll(async () => {
  await screen?.close();
  await flight.end();
});

test("a flight is recorded, and the folder holds a torn one and one that is no log", async () => {
  explain(flight.station);
  screen = await Screen.open();
  await flight.loseAndClimb(screen);
  const whole = readFileSync(`${flight.folder}/${kName}`);
  const third = Math.floor(whole.length / 3);
  writeFileSync(`${flight.folder}/${kTorn}`, whole.subarray(0, 2 * third));
  appendFileSync(`${flight.folder}/${kTorn}`, Buffer.alloc(5000, 0x55));
  appendFileSync(`${flight.folder}/${kTorn}`, whole.subarray(2 * third, whole.length - 77));
  writeFileSync(`${flight.folder}/${kNotes}`, "This is no log. ".repeat(100));
});

test("the list tells of each what is in it, and what cannot be opened", async () => {
  explain(flight.station);
  await page().keyboard.press("r");
  await until(async () => {
    const told = await entry(kName).innerText();
    for (const part of ["Alarms", "UTC", "3 UAVs", "alarm", "kB"])
      expect(told.replace("MB", "kB")).toContain(part);
    expect(await entry(kNotes).innerText()).toContain("Can't be opened");
  }, 30_000);
  for (const theme of ["dark", "light"] as const) {
    await screen.picture("recordings", 1280, 720, theme);
    expect(await screen.barriers()).toEqual([]);
  }
});

test("its file can be taken away, byte for byte", async () => {
  explain(flight.station);
  const [download] = await Promise.all([
    page().waitForEvent("download"),
    page()
      .getByRole("link", { name: `Download ${kName}` })
      .click(),
  ]);
  expect(readFileSync(await download.path()).equals(readFileSync(`${flight.folder}/${kName}`))).toBe(true);
});

test("a damaged recording opens, plays what is there, and says what is missing", async () => {
  explain(flight.station);
  await page().goto(`${kPageUrl}?recording=${kTorn}`);
  await page().locator(".playhead").waitFor();
  await until(async () => expect(await screen.text(".timeline-damage summary")).toContain("can't be read"));
  await page().locator(".timeline-damage summary").click();
  expect(await page().locator(".timeline-damage li").count()).toBeGreaterThan(0);
  await page().getByLabel("Go to a time").fill("5");
  await page().keyboard.press("Enter");
  await until(async () => expect(await page().locator("tbody tr").count()).toBe(3));
  await screen.picture("recording-torn", 1280, 720, "dark");
});

test("what cannot be opened says why, and leads back", async () => {
  explain(flight.station);
  await page().goto(`${kPageUrl}?recording=${kNotes}`);
  await until(async () => expect(await screen.text(".opening")).toMatch(/can't be opened/));
  await page().goto(`${kPageUrl}?recording=nothing.lcm`);
  await until(async () => expect(await screen.text(".opening")).toMatch(/nothing\.lcm can't be opened/));
  await screen.picture("recording-missing", 1280, 720, "light");
  await page()
    .getByRole("link", { name: /Leave|All/ })
    .click();
  await until(async () => expect(await screen.text(".pill")).toBe("Live"), 20_000);
});

test("who holds control deletes it, after being asked with its name", async () => {
  explain(flight.station);
  await until(async () => expect(await screen.text(".control-who")).toBe("You"), 20_000);
  if ((await page().locator(".recordings").count()) === 0) await page().keyboard.press("r");
  await screen.button(`Delete ${kTorn}…`).click();
  const dialog = page().getByRole("dialog", { name: "Delete this recording?" });
  expect(await dialog.innerText()).toContain(kTorn);
  await screen.picture("recording-delete", 1280, 720, "dark");
  await dialog.getByRole("button", { name: "Keep it" }).click();
  expect(existsSync(`${flight.folder}/${kTorn}`)).toBe(true);
  await screen.button(`Delete ${kTorn}…`).click();
  await dialog.getByRole("button", { name: "Delete for good" }).click();
  await until(async () => expect(await entry(kTorn).count()).toBe(0));
  expect(existsSync(`${flight.folder}/${kTorn}`)).toBe(false);
  expect(statSync(`${flight.folder}/${kName}`).size).toBeGreaterThan(0);
});

test("nothing was complained of but what cannot be opened, and no request left this machine", () => {
  // The page goes on asking until it is left, and the browser tells each refusal in words of its own.
  const of_refusals = new RegExp(`recordings?[=/](${kNotes}|nothing\\.lcm)`);
  expect(screen.complaints.filter((text) => !of_refusals.test(text))).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
