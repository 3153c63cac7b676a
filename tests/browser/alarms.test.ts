/** Two people at two browsers: a link is lost, the alarm flashes and sounds, one of them looks after it, and both see that. One flight, in order. */
import { afterAll, beforeAll, expect, test, vi } from "vitest";
import { Screen } from "./screen";
import { explain, kPageUrl, Station } from "./station";

const station = new Station({ scenario: "alarms.json" });
let screen: Screen;
let other: Screen;

const until = (what: () => Promise<void> | void, timeout: number) =>
  vi.waitFor(what, { timeout, interval: 100 });
const link3 = (of: Screen) => of.page.locator('.alarms .alarm[data-condition="link:3"]').first();
const both = () => [screen, other];

/** What a program on this machine asks the simulator for. */
async function setLink(mode: "up" | "silent"): Promise<void> {
  const response = await fetch(`${kPageUrl}api/command`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({
      channel: "CMD_LINK",
      body: { vehicle_id: 3, mode },
    }),
  });
  expect(response.status).toBe(200);
}

/** Notes that were played. */
const notes = () => screen.page.evaluate(() => (globalThis as { notes?: number }).notes ?? 0);

async function until_state(state: number, flashes: boolean, timeout: number): Promise<void> {
  for (const one of both()) {
    await until(async () => {
      expect(await link3(one).getAttribute("data-state")).toBe(String(state));
      expect(await link3(one).evaluate((row) => row.classList.contains("flashes"))).toBe(flashes);
    }, timeout);
  }
}

beforeAll(async () => {
  station.start();
  await station.answers();
  screen = await Screen.open();
  await screen.page.addInitScript(() => {
    // Counts the tones, which a test can't hear.
    const start = OscillatorNode.prototype.start;
    const counted = globalThis as { notes?: number };
    OscillatorNode.prototype.start = function (when?: number) {
      counted.notes = (counted.notes ?? 0) + 1;
      start.call(this, when);
    };
    // Whatever a test evaluates counts as a gesture; only a press shall.
    let touched = false;
    for (const gesture of ["pointerdown", "keydown"])
      addEventListener(gesture, () => (touched = true), { capture: true });
    Object.defineProperty(UserActivation.prototype, "hasBeenActive", {
      get: () => touched,
    });
  });
  await screen.page.reload();
  other = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  await other?.close();
  await station.stopAll();
});

test("while all is well no alarm is on, and the page says what the sound waits for", async () => {
  explain(station);
  await until(async () => expect(await screen.text(".pill")).toBe("Live"), 20_000);
  await until(async () => expect(await screen.text(".alarms")).toContain("no alarm is on"), 10_000);
  expect(await screen.page.locator(".badges").getAttribute("title")).toBe("Alarms: no warnings; no cautions");
  expect(await screen.text(".sound-button")).toContain("Enable");
  await screen.page.locator(".sound-button").click();
  await until(async () => expect(await screen.text(".sound-button")).not.toContain("Enable"), 2000);
  await screen.page.getByRole("button", { name: "Hear how a warning sounds" }).click();
  expect(await notes()).toBe(5);
  await screen.picture("alarms-sound", 1280, 720, "dark");
  await screen.page.keyboard.press("Escape");
});

test("a lost link flashes in both browsers and sounds, and the mode line tells the climb and why", async () => {
  explain(station);
  await setLink("silent");
  await until(async () => expect(await link3(screen).innerText()).toContain("Link of UAV3 lost"), 10_000);
  await until_state(0, true, 3000);
  expect(await screen.page.locator(".badges").getAttribute("title")).toContain("1 warning, 1 unacknowledged");
  const sounded = await notes();
  expect(sounded).toBeGreaterThan(5);
  await until(async () => expect(await notes()).toBeGreaterThan(sounded), 6000);

  await until(async () => {
    const text = await screen.text(".mode-card");
    expect(text).toMatch(/Climbing 200 m( \(\d+ m to go\))?: link of UAV3 lost \d+ s ago/);
    expect(text).toMatch(/\d+ s to go, until T\+ 0:\d\d:\d\d/);
  }, 10_000);

  const flash = () =>
    link3(screen).evaluate((row) => {
      const { animationName, animationDuration } = getComputedStyle(row);
      return [animationName, parseFloat(animationDuration)] as const;
    });
  const [name, seconds] = await flash();
  expect(name).toBe("alarm-flash");
  expect(seconds).toBeGreaterThanOrEqual(0.5);
  await screen.page.emulateMedia({ reducedMotion: "reduce" });
  expect((await flash())[0]).toBe("none");
  await screen.page.emulateMedia({ reducedMotion: "no-preference" });
  for (const [width, height, theme] of [
    [1280, 720, "dark"],
    [1920, 1080, "light"],
  ] as const) {
    await screen.picture("alarms", width, height, theme);
    expect(await screen.barriers()).toEqual([]);
  }
});

test("the sound is muted by key for a minute that counts down, and comes back", async () => {
  await screen.page.keyboard.press("Shift+M");
  await until(async () => expect(await screen.text(".mute-left")).toMatch(/^0:5\d$/), 3000);
  const muted = await notes();
  await until(async () => expect(await screen.text(".mute-left")).toMatch(/^0:5[0-5]$/), 8000);
  expect(await notes()).toBe(muted);
  await screen.page.keyboard.press("Shift+M");
  await until(async () => expect(await notes()).toBeGreaterThan(muted), 6000);
});

test("who acknowledges it in one browser makes it steady in both, by the bus", async () => {
  explain(station);
  await link3(screen).focus();
  await screen.page.keyboard.press("Enter");
  await until_state(1, false, 3000);
  for (const one of both()) {
    expect(await link3(one).innerText()).toMatch(/acknowledged by /);
    expect(await one.page.locator(".badges .flashes").count()).toBe(0);
  }
  const quiet = await notes();
  // The monitor has said so: it is in the recording.
  await other.page.getByRole("tab", { name: "Events" }).click();
  await other.page.locator('.events li[title*=": alarm_acknowledged,"]').waitFor({ timeout: 3000 });
  await other.page.getByRole("tab", { name: "Alarms" }).click();
  // Unacknowledged it would have sounded again after 4 s.
  await screen.flies(6);
  expect(await notes()).toBe(quiet);
});

test("an alarm is shelved for a time that counts down, and flashes when it is taken off the shelf", async () => {
  explain(station);
  await link3(screen).getByRole("button", { name: "Shelve", exact: true }).click();
  await link3(screen).getByRole("button", { name: "Shelve for 1 min" }).click();
  await until_state(3, false, 3000);
  await until(async () => expect(await link3(other).innerText()).toMatch(/shelved by .*, 0:5\d left/), 3000);
  expect(await screen.page.locator(".badges").getAttribute("title")).toContain("no warnings");
  await screen.picture("alarms-shelved", 1280, 720, "light");
  await screen.page.getByRole("button", { name: /^Unshelve/ }).click();
  await until_state(0, true, 3000);
});

test("a key that is held down does its work once", async () => {
  await screen.page.keyboard.down("Shift");
  await screen.page.keyboard.down("M");
  await until(async () => expect(await screen.page.locator(".mute-left").count()).toBe(1), 2000);
  // The browser's repetition of a key that stays down.
  await screen.page.keyboard.down("M");
  expect(await screen.page.locator(".mute-left").count()).toBe(1);
  await screen.page.keyboard.up("M");
  await screen.page.keyboard.up("Shift");
  await screen.page.keyboard.press("Shift+M");
  await until(async () => expect(await screen.page.locator(".mute-left").count()).toBe(0), 2000);
});

test("one that has ended unseen stays until it is acknowledged, and is then history in both", async () => {
  explain(station);
  await setLink("up");
  await until_state(2, true, 10_000);
  expect(await link3(screen).innerText()).toContain("has ended");
  await screen.page.keyboard.press("Shift+A");
  for (const one of both()) {
    await until(async () => expect(await one.text(".alarms")).toContain("no alarm is on"), 3000);
    await one.page.locator(".alarms-group summary", { hasText: "History" }).click();
    expect(await link3(one).innerText()).toMatch(/over, acknowledged by /);
  }
});

test("events are found by word, by severity and by UAV, which a click selects", async () => {
  explain(station);
  await screen.page.getByRole("tab", { name: "Events" }).click();
  const codes = () =>
    screen.page
      .locator(".events li[title]")
      .evaluateAll((rows) => rows.map((row) => /: (\w+),/.exec(row.getAttribute("title") ?? "")?.[1]));
  await screen.page.getByLabel("Search events").fill("uav3 link_l nothing");
  await until(async () => expect(await codes()).toEqual(["link_lost", "link_late"]), 3000);
  await screen.page.getByLabel("Severity").selectOption("Warnings");
  await until(async () => expect(await codes()).toEqual(["link_lost"]), 3000);
  await screen.page.locator(".events").getByRole("button", { name: "UAV3" }).click();
  await screen.page.getByLabel("Search events").fill("");
  await screen.page.getByLabel("Severity").selectOption("All");
  await screen.page.getByLabel("Selected UAVs").check();
  await until(async () => expect(await codes()).toContain("link_cut"), 3000);
  await screen.picture("events", 1280, 720, "dark");
  expect(await screen.barriers()).toEqual([]);
});

test("without the monitor the page says that no alarms can come", async () => {
  explain(station);
  await station.stop("collision-monitor");
  await until(async () => expect(await screen.text(".badges")).toBe("No alarms can come"), 8000);
  expect(await screen.text(".banner")).toContain("No alarms can come");
  await screen.picture("alarms-monitor-silent", 1280, 720, "dark");
  station.start("collision-monitor");
  await until(async () => expect(await screen.text(".badges")).not.toContain("No alarms"), 8000);
});

test("nothing was complained of, and no request left this machine", () => {
  for (const one of both()) {
    expect(one.complaints).toEqual([]);
    expect(one.strangers).toEqual([]);
  }
});
