/** Two people at the page: one commands, the other looks on, asks, is given control, goes and comes back. */
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until } from "./screen";
import { explain, Station } from "./station";

const station = new Station({ scenario: "roles.json" });
let ada: Screen;
let bob: Screen;

const who = (screen: Screen) => screen.text(".control-who");
const menu = (screen: Screen) => screen.page.locator(".control-pill").click();
const payload = (screen: Screen) => screen.payload("UAV1");

/** Types a name into the open menu. */
async function callThemselves(screen: Screen, name: string): Promise<void> {
  const field = screen.page.getByLabel("Your name");
  await field.fill("");
  expect(await screen.page.locator(".name-form .problem").innerText()).toMatch(/name/);
  await field.fill(name);
  await screen.button("Save").click();
}

beforeAll(async () => {
  station.start();
  await station.answers();
  ada = await Screen.open();
  await ada.row(1).waitFor();
  await until(async () => expect(await who(ada)).toBe("You"));
  bob = await Screen.open();
  await bob.row(1).waitFor();
});

afterAll(async () => {
  await ada?.close();
  await bob?.close();
  await station.stopAll();
});

test("the first has control, the second sees who has it, by name", async () => {
  explain(station);
  await until(async () => expect(await who(bob)).toBe("Operator 1"));
  await menu(ada);
  await callThemselves(ada, "Ada");
  await until(async () => expect(await who(bob)).toBe("Ada"));
  await ada.page.keyboard.press("Escape");
});

test("who looks on sees that nothing can be commanded, and why", async () => {
  explain(station);
  expect(await payload(bob).getAttribute("aria-disabled")).toBe("true");
  expect(await payload(bob).getAttribute("title")).toBe("Payload of UAV1: Ada holds control");
  await payload(bob).click({ force: true });
  expect(await bob.text(".refusal")).toContain("Ada holds control");
  await bob.button("Dismiss").click();
  // In the top bar there is room below the control only. Before a formation is heard there is nothing to hold.
  await bob.page.locator(".hold-all:enabled").click({ force: true });
  const refusal = await bob.page.locator(".refusal").boundingBox();
  expect(refusal?.y ?? -1).toBeGreaterThan(0);
  await bob.button("Dismiss").click();
  await payload(ada).click();
  await until(async () => expect((await bob.uav(1)).payload_on).toBe(true));
});

test("a request is put before the holder, who may refuse it", async () => {
  explain(station);
  await menu(bob);
  await callThemselves(bob, "Bob");
  await bob.button("Ask for control").click();
  await ada.page.getByText("Bob asks for control.").waitFor();
  await ada.picture("control-asked", 1280, 720, "dark");
  await bob.picture("control-waits", 1280, 720, "light");
  await ada.button("Keep control, refuse Bob").click();
  await bob.page.getByText("Ada keeps control.").waitFor();
  expect(await who(bob)).toBe("Ada");
});

test("handed over, control is with the other, and both are told", async () => {
  explain(station);
  await bob.page.keyboard.press("Escape");
  await bob.page.keyboard.press("Shift+C");
  await ada.button("Give control to Bob").click();
  await bob.page.getByText("You have control now.").waitFor();
  await ada.page.getByText("Bob has control now. You are looking on.").waitFor();
  expect(await who(bob)).toBe("You");
  expect(await who(ada)).toBe("Bob");
  expect(await payload(ada).getAttribute("aria-disabled")).toBe("true");
  await payload(bob).click();
  await until(async () => expect((await ada.uav(1)).payload_on).toBe(false));
});

test("a duplicated tab is somebody else", async () => {
  explain(station);
  // A window that a page opens has a copy of its session storage, like a duplicated tab.
  const [copy] = await Promise.all([
    bob.page.waitForEvent("popup"),
    bob.page.evaluate(() => {
      window.open(location.href);
    }),
  ]);
  await copy.locator(".control-who", { hasText: "Bob" }).waitFor();
  expect(await who(bob)).toBe("You");
  await copy.close();
});

test("after a reload the holder has control again", async () => {
  explain(station);
  await bob.page.reload();
  await until(async () => expect(await who(bob)).toBe("You"));
  expect(await who(ada)).toBe("Bob");
});

test("the menu keeps nobody out, in either theme", async () => {
  explain(station);
  await menu(bob);
  await bob.page.getByText("You command the fleet.").waitFor();
  for (const theme of ["dark", "light"] as const) {
    await bob.picture("control-menu", 1280, 720, theme);
    await bob.picture("control-menu", 1920, 1080, theme);
    expect(await bob.barriers()).toEqual([]);
  }
});

test("control of a holder who is gone for ten seconds goes to who asked for it", async () => {
  explain(station);
  await bob.page.goto("about:blank");
  await menu(ada);
  await ada.button("Ask for control").click();
  await ada.page.getByText("Bob is gone").waitFor();
  await until(async () => expect(await who(ada)).toBe("You"), 15_000);
});

test("what became of control is among the events, so it is in the recording", async () => {
  explain(station);
  await ada.page.getByRole("tab", { name: "Events" }).click();
  for (const text of [
    "Ada has handed control over to Bob",
    "Bob has been gone for 10 s",
    "Ada, who had asked for it, has control",
  ]) {
    await until(async () => expect((await ada.text(".events")).toLowerCase()).toContain(text.toLowerCase()));
  }
});

test("released, control is nobody's until it is taken, and who only wants to look does not take it", async () => {
  explain(station);
  await menu(ada);
  await ada.button("Release control").click();
  await until(async () => expect(await who(ada)).toBe("Nobody"));
  await ada.page.getByLabel("View only").check();
  await ada.page.reload();
  await until(async () => expect(await who(ada)).toBe("Nobody"));
  expect(await payload(ada).getAttribute("title")).toContain("Nobody holds control");
  await menu(ada);
  await ada.button("Take control").click();
  await until(async () => expect(await who(ada)).toBe("You"));
  await ada.page.keyboard.press("Escape");
});

test("hold is in reach of whoever is there: it takes control that nobody holds", async () => {
  explain(station);
  await menu(ada);
  await ada.button("Release control").click();
  await until(async () => expect(await who(ada)).toBe("Nobody"));
  await ada.page.keyboard.press("Escape");
  await ada.page.keyboard.press("h");
  await until(async () => expect(await ada.text(".hold-all")).toContain("Holding"));
  expect(await who(ada)).toBe("You");
});

test("nothing was complained of, and no request left this machine", () => {
  for (const screen of [ada, bob]) {
    expect(screen.complaints).toEqual([]);
    expect(screen.strangers.filter((url) => url !== "about:blank")).toEqual([]);
  }
});
