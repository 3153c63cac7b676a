/** Whether the flight is recorded, as the page tells it, and what an operator does about that. */
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until } from "./screen";
import { explain, Station } from "./station";

const station = new Station({ scenario: "roles.json" });
let ada: Screen;
let bob: Screen;

const pill = (screen: Screen) => screen.page.locator(".recording-pill");
const menu = (screen: Screen) => screen.page.locator(".recording-menu");
const says = (text: string) => until(async () => expect(await pill(ada).innerText()).toContain(text));
const events = (screen: Screen) => screen.page.locator(".events");

beforeAll(async () => {
  station.start();
  await station.answers();
  ada = await Screen.open();
  await ada.row(1).waitFor();
  await until(async () => expect(await ada.text(".control-who")).toBe("You"));
  bob = await Screen.open();
  await ada.page.getByRole("tab", { name: "Events" }).click();
});

afterAll(async () => {
  await ada?.close();
  await bob?.close();
  await station.stopAll();
});

test("a flight that nobody records says so, and why", async () => {
  explain(station);
  await says("Not recording");
  expect(await pill(ada).getAttribute("title")).toContain("flight-recorder isn't heard");
  await ada.picture("not-recording", 1280, 720, "dark");
  await ada.picture("not-recording", 1280, 720, "light");
});

test("with flight-recorder on the bus, the time and the size of the recording are in sight", async () => {
  explain(station);
  station.start("flight-recorder");
  await says("Rec");
  await events(ada).getByText("recording to ").first().waitFor();
  await pill(ada).click();
  await until(async () => expect(await menu(ada).innerText()).toMatch(/roles-\d{8}-\d{6}\.lcm/));
  await ada.picture("recording-menu", 1280, 720, "dark");
  await ada.picture("recording-menu", 1920, 1080, "light");
  expect(await ada.barriers()).toEqual([]);
  await ada.page.keyboard.press("Escape");
});

test("a marker is put by keyboard alone, and all can read it", async () => {
  explain(station);
  // Typed on at once: no letter may be lost, or taken for a shortcut.
  await ada.page.keyboard.type("kGusts from here on");
  await ada.page.keyboard.press("Enter");
  await ada.page.getByText("Put: Gusts from here on").waitFor();
  await events(ada).getByText("Gusts from here on").waitFor();
  await ada.page.keyboard.press("Escape");
});

test("who only looks on can neither stop the recording nor write into it, and is told why", async () => {
  explain(station);
  await pill(bob).click();
  await bob.button("Stop recording").click({ force: true });
  expect(await bob.text(".refusal")).toContain("holds control");
  await bob.button("Dismiss").click();
  await bob.page.getByLabel("Marker", { exact: true }).fill("from outside");
  await bob.page.keyboard.press("Enter");
  expect(await bob.text(".refusal")).toContain("holds control");
  await bob.button("Dismiss").click();
  await says("Rec");
});

test("the operator stops it and starts another one", async () => {
  explain(station);
  await pill(ada).click();
  await ada.button("Stop recording").click();
  await says("Not recording");
  await until(async () => expect(await menu(ada).innerText()).toContain("stopped by"));
  await ada.picture("recording-stopped", 1280, 720, "dark");
  // At once: lcm-logger may still be writing the last of it.
  await ada.button("Start recording").click();
  await says("Rec");
  await ada.page.keyboard.press("Escape");
});

test("a killed logger is seen at once, and within two seconds it records again in a second file", async () => {
  explain(station);
  await ada.page.evaluate(() => {
    const seen: string[] = [];
    Object.assign(window, { seen });
    const look = () => {
      seen.push(document.querySelector(".recording-pill")?.textContent ?? "");
    };
    new MutationObserver(look).observe(document.querySelector(".recording") ?? document.body, {
      subtree: true,
      childList: true,
      characterData: true,
    });
  });
  station.killLogger();
  await events(ada).getByText("lcm-logger was killed (signal 9)").waitFor({ timeout: 2000 });
  await events(ada).getByText("recording again, to ").waitFor({ timeout: 2000 });
  const seen = await ada.page.evaluate(() => (window as unknown as { seen: string[] }).seen);
  expect(seen.some((text) => text.includes("Not recording"))).toBe(true);
  await says("Rec");
  await pill(ada).click();
  await until(async () => expect(await menu(ada).innerText()).toContain("in 2 files"));
  await ada.page.keyboard.press("Escape");
});

test("a recorder that is gone is not believed any longer, and takes nobody's note away", async () => {
  explain(station);
  await ada.page.keyboard.type("kGus");
  await station.stop("flight-recorder");
  await says("Not recording");
  await until(async () =>
    expect(await pill(ada).getAttribute("title")).toContain("flight-recorder isn't heard"),
  );
  await ada.page.keyboard.type("the");
  expect(await ada.page.getByLabel("Marker", { exact: true }).inputValue()).toBe("Gusthe");
  expect(await ada.button("Put the marker").isDisabled()).toBe(true);
  await ada.page.keyboard.press("Escape");
});

test("nothing was complained of, and no request left this machine", () => {
  for (const screen of [ada, bob]) {
    expect(screen.complaints).toEqual([]);
    expect(screen.strangers).toEqual([]);
  }
});
