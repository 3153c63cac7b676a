/** A recorded flight is opened and scrubbed through: played, reversed, stepped, looped, dragged; at any moment of it everything is as it was. */
import { afterAll, beforeAll, expect, test } from "vitest";
import { kName, RecordedFlight } from "./recorded_flight";
import { Screen, appears, until } from "./screen";
import { explain } from "./station";
import { TimeLine } from "./time_line";

const flight = new RecordedFlight();
let screen: Screen;
let time_line: TimeLine;
/** How high UAV1 was when the recording ended. */
let altitude_then_m: number;

const page = () => screen.page;
const at_s = () => time_line.at_s();
const goTo = (text: string) => time_line.goTo(text);

beforeAll(async () => {
  await flight.start();
});

afterAll(async () => {
  await screen?.close();
  await flight.end();
});

test("a flight with a lost link is recorded", async () => {
  explain(flight.station);
  screen = await Screen.open();
  time_line = new TimeLine(screen);
  altitude_then_m = await flight.loseAndClimb(screen);
});

test("opened by a click, it stands at its beginning under a banner, and nothing can be commanded", async () => {
  explain(flight.station);
  await page().keyboard.press("r");
  await page()
    .getByRole("link", { name: `Open ${kName}`, exact: true })
    .last()
    .click();
  await page().waitForURL(/recording=Alarms/);
  await page().locator(".playhead").waitFor();
  expect(await screen.text(".replay-banner")).toContain(kName);
  expect(await at_s()).toBe(0);
  await goTo("5");
  await until(async () => expect(await page().locator("tbody tr").count()).toBe(3));
  expect(await screen.payload("UAV1").getAttribute("aria-disabled")).toBe("true");
  expect(await screen.payload("UAV1").getAttribute("title")).toContain("nothing can be commanded");
  expect(await page().locator(".hold-all").getAttribute("aria-disabled")).toBe("true");
  expect(await page().locator(".control-pill").count()).toBe(0);
  expect(await page().locator(".banner").count()).toBe(0);
});

test("Space plays and pauses, and the time stands while it is paused", async () => {
  explain(flight.station);
  const before_s = await at_s();
  await page().keyboard.press("Space");
  await until(async () => expect(await at_s()).toBeGreaterThan(before_s + 0.5));
  expect(await screen.button("Pause").count()).toBe(1);
  await page().keyboard.press("Space");
  await screen.button("Play").waitFor();
  const then_s = await at_s();
  for (let step = 1; step <= 10; step += 1) await page().keyboard.press(".");
  // Ten steps of 0.05 s on, and nothing beside them.
  await until(async () => expect(Math.abs((await at_s()) - then_s - 0.5)).toBeLessThan(0.11));
});

test("at the next alarm everything is as it was: the list, the link, the events, the altitude", async () => {
  explain(flight.station);
  await page().getByRole("tab", { name: "Events" }).click();
  await goTo("0");
  await until(async () => expect(await at_s()).toBe(0));
  await until(async () => expect(await screen.text(".events")).not.toContain("UAV3"));
  await page().keyboard.press("Control+ArrowRight");
  await until(async () => expect(await at_s()).toBeGreaterThan(1));
  // There may be others before it. The picture of a moment comes after its time.
  const of_uav3 = page()
    .locator(".events li", { hasText: /link of UAV3 lost/ })
    .first();
  for (let i = 0; i < 20 && !(await appears(of_uav3, 3000)); i += 1) {
    const before_s = await at_s();
    await page().keyboard.press("Control+ArrowRight");
    await until(async () => expect(await at_s()).toBeGreaterThan(before_s));
  }
  await goTo("+2");
  await until(async () => expect((await screen.uav(3)).downlink).toBe("lost"));
  await page().getByRole("tab", { name: "Alarms" }).click();
  await until(async () => expect(await screen.text(".alarms")).toContain("UAV3"));
  const { altitude_m } = await screen.uav(1);
  expect(altitude_m).toBeLessThan(altitude_then_m);
  await time_line.line.focus();
  await page().keyboard.press("End");
  await until(async () => {
    const at_the_end_m = (await screen.uav(1)).altitude_m;
    expect(at_the_end_m).toBeGreaterThan(1030);
    expect(Math.abs(at_the_end_m - altitude_then_m)).toBeLessThan(40);
  });
  await page().keyboard.press("Control+ArrowLeft");
  await until(async () => expect(await at_s()).toBeLessThan((await time_line.duration_s()) - 1));
});

test("no alarm sounds unless it is switched on", async () => {
  explain(flight.station);
  const sound = page().locator(".sound-button");
  expect(await sound.getAttribute("aria-label")).toContain("off");
  await sound.click();
  await page().getByLabel("Hear the alarms of this replay").check();
  expect(await sound.getAttribute("aria-label")).toContain("on");
  await page().getByLabel("Hear the alarms of this replay").uncheck();
  await page().keyboard.press("Escape");
});

test("dragged along the line, the fleet follows the hand", async () => {
  explain(flight.station);
  const length_s = await time_line.duration_s();
  const moveTo = async (part: number) => {
    const { x, y } = await time_line.placeOf(part);
    await page().mouse.move(x, y);
  };
  await moveTo(0.2);
  await page().mouse.down();
  await until(async () => expect(Math.abs((await at_s()) - 0.2 * length_s)).toBeLessThan(0.2));
  const from_s = await screen.elapsed_s();
  for (const part of [0.3, 0.4, 0.5, 0.6, 0.7, 0.8]) await moveTo(part);
  await until(async () => expect(Math.abs((await at_s()) - 0.8 * length_s)).toBeLessThan(0.2));
  // The flight's own clock comes with where the fleet is.
  await until(async () =>
    expect(Math.abs((await screen.elapsed_s()) - from_s - 0.6 * length_s)).toBeLessThan(1.5),
  );
  await page().mouse.up();
  await until(async () => expect(Math.abs((await at_s()) - 0.8 * length_s)).toBeLessThan(0.2));
});

test("a finger goes to a time, and two fingers show less of the recording", async () => {
  explain(flight.station);
  const length_s = await time_line.duration_s();
  const hand = await page().context().newCDPSession(page());
  const touch = async (type: "touchStart" | "touchMove" | "touchEnd", ...parts: number[]) => {
    const places = await Promise.all(parts.map((part) => time_line.placeOf(part)));
    await hand.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: places.map((place, id) => ({ ...place, id })),
    });
  };
  await touch("touchStart", 0.3);
  await touch("touchMove", 0.4);
  await touch("touchMove", 0.5);
  await until(async () => expect(Math.abs((await at_s()) - 0.5 * length_s)).toBeLessThan(0.3));
  await touch("touchEnd");
  await touch("touchStart", 0.45);
  await touch("touchStart", 0.45, 0.55);
  await touch("touchMove", 0.3, 0.7);
  await touch("touchEnd");
  const whole = screen.button("Whole recording");
  await whole.waitFor();
  await until(async () => expect(Math.abs((await at_s()) - 0.5 * length_s)).toBeLessThan(0.2 * length_s));
  await whole.click();
  await until(async () => expect(await whole.count()).toBe(0));
  await hand.detach();
});

test("backwards, in fast motion, and to its end", async () => {
  explain(flight.station);
  const from_s = await at_s();
  await page().keyboard.press("j");
  await until(async () => expect(await at_s()).toBeLessThan(from_s - 1));
  await page().keyboard.press("j");
  await screen.button("Play").waitFor();
  await page().getByLabel("Speed").selectOption("50");
  await until(async () => expect(await page().getByLabel("Speed").inputValue()).toBe("50"));
  await page().keyboard.press("Escape");
  await time_line.line.focus();
  await page().keyboard.press("Home");
  await page().keyboard.press("Space");
  await until(async () => expect(await at_s()).toBeGreaterThan((await time_line.duration_s()) - 0.2));
  await screen.button("Play").waitFor();
  await page().keyboard.press("<");
  await until(async () => expect(await page().getByLabel("Speed").inputValue()).toBe("20"));
});

test("between A and B it goes round", async () => {
  explain(flight.station);
  await page().getByLabel("Speed").selectOption("5");
  await goTo("5");
  await until(async () => expect(await at_s()).toBe(5));
  await page().keyboard.press("i");
  await goTo("7");
  await until(async () => expect(await at_s()).toBe(7));
  await page().keyboard.press("o");
  await screen.button("No loop").waitFor();
  await page().keyboard.press("Space");
  let last_s = 7;
  let rounds = 0;
  await until(async () => {
    const now_s = await at_s();
    expect(now_s).toBeGreaterThanOrEqual(4.9);
    expect(now_s).toBeLessThanOrEqual(7.1);
    if (now_s < last_s) rounds += 1;
    last_s = now_s;
    expect(rounds).toBeGreaterThan(2);
  });
  await page().keyboard.press("Space");
  await page().keyboard.press("Shift+O");
  await until(async () => expect(await screen.button("No loop").count()).toBe(0));
});

test("the charts show all of the flight at once, and where in it we are", async () => {
  explain(flight.station);
  await page().getByRole("tab", { name: "Charts" }).click();
  const plot = page().locator('[data-chart="up_m"] .u-over');
  await plot.waitFor();
  const played = plot.locator(".played");
  const left = async () => (await played.boundingBox())?.x ?? NaN;
  await goTo("5");
  // The tab has only just been opened.
  const box = await screen.atRest(() => plot.boundingBox());
  if (box === null) throw new Error("the chart isn't there");
  await until(async () => expect(await left()).toBeLessThan(box.x + box.width / 2));
  // A press on a chart goes there.
  await plot.click({ position: { x: box.width * 0.9, y: box.height / 2 } });
  await until(async () => expect(Math.abs((await left()) - box.x - box.width * 0.9)).toBeLessThan(4));
  for (const theme of ["dark", "light"] as const) {
    await screen.picture("recording-charts", 1920, 1080, theme);
    expect(await screen.barriers()).toEqual([]);
  }
  await screen.show(1280, 720, "dark");
  await page().getByRole("tab", { name: "Table" }).click();
});

test("a time that is none is told beside the field, with what can be typed", async () => {
  explain(flight.station);
  await goTo("soon");
  const problem = page().locator(".go-to .field-problem");
  expect(await problem.innerText()).toContain("1:30");
  await page().keyboard.press("Escape");
  expect(await problem.count()).toBe(0);
});

test("the line and its keys keep nobody out, in every size and theme", async () => {
  explain(flight.station);
  await goTo("8");
  await time_line.line.hover();
  for (const theme of ["dark", "light"] as const) {
    for (const [width, height] of [
      [1280, 720],
      [1920, 1080],
      [820, 1180],
    ] as const) {
      await screen.picture("recording", width, height, theme);
      const out = await page().evaluate(() => {
        const { scrollWidth, scrollHeight } = document.documentElement;
        return scrollWidth > innerWidth || scrollHeight > innerHeight;
      });
      expect(out, `${width}x${height}`).toBe(false);
    }
    expect(await screen.barriers()).toEqual([]);
  }
  await screen.show(1280, 720, "dark");
  await page().keyboard.press("?");
  expect(await screen.text(".help")).toContain("Next alarm or marker");
  const keys = await page().locator(".help dt").allInnerTexts();
  expect(keys.filter((key, i) => keys.indexOf(key) !== i)).toEqual([]); // no key does two things
  await page().keyboard.press("Escape");
});

test("two people look at different moments of it", async () => {
  explain(flight.station);
  const here_s = await at_s();
  const other = await Screen.open(`?recording=${kName}`);
  const there = new TimeLine(other);
  await other.page.locator(".playhead").waitFor();
  await there.line.focus();
  await other.page.keyboard.press("End");
  await until(async () => expect(await there.at_s()).toBeGreaterThan(here_s + 3));
  expect(await at_s()).toBe(here_s);
  expect(other.complaints).toEqual([]);
  await other.close();
});

test("when the bridge comes back, the page is where it was", async () => {
  explain(flight.station);
  const [before_s, elapsed_s] = [await at_s(), await screen.elapsed_s()];
  await flight.station.stop("web-bridge");
  await until(async () => expect(await screen.text(".banner")).toContain("Reconnecting"));
  flight.station.start("web-bridge");
  await flight.station.answers();
  await until(async () => {
    expect(await page().locator(".banner").count()).toBe(0);
    expect(await time_line.line.getAttribute("aria-disabled")).toBe("false");
    expect(await at_s()).toBeCloseTo(before_s, 1);
  }, 30_000);
  expect(await screen.elapsed_s()).toBe(elapsed_s);
  // The connection that broke is in the console; that is how browsers are.
  screen.complaints.length = 0;
});

test("nothing was complained of, and no request left this machine", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
