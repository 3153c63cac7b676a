/** A person who tries things out on a simulated fleet: cuts links, makes them lossy, starts the scenario anew, loads another. */
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until } from "./screen";
import { explain, Station } from "./station";

const station = new Station({ scenario: "simulation.json" });
let screen: Screen;

/** What the panel says was done last to the link of a UAV. */
const word = (id: number) => screen.text(`.links li[data-id="${id}"] .last-word`);
const choose = (name: string) => screen.page.getByRole("radio", { name, exact: true }).check({ force: true });
const type = async (label: string, text: string) => {
  const field = screen.page.getByRole("textbox", { name: label, exact: true });
  await field.fill(text);
  await field.press("Enter");
};
async function elapsed_s(): Promise<number> {
  const [hours = NaN, minutes = NaN, seconds = NaN] = (await screen.text(".elapsed")).split(":").map(Number);
  return 3600 * hours + 60 * minutes + seconds;
}

beforeAll(async () => {
  station.start();
  await station.answers();
  screen = await Screen.open();
  await screen.row(2).waitFor();
  await screen.page.getByRole("tab", { name: "Events" }).click();
  await screen.button("Simulation").click();
  await screen.page.getByRole("heading", { name: "Data links of all 2 UAVs" }).waitFor();
});

afterAll(async () => {
  await screen?.close();
  await station.stopAll();
});

test("the downlink of one UAV is cut for some seconds, and comes back by itself", async () => {
  explain(station);
  await screen.row(2).getByText("UAV2", { exact: true }).click();
  await choose("Downlink");
  await type("For [s]", "5");
  await screen.button("Cut the links of UAV2").click();
  // One after the other: it is lost when the cut is almost over.
  await until(async () => expect(await word(2)).toMatch(/downlink.* cut/));
  await until(async () => expect((await screen.uav(2)).downlink).toBe("lost"));
  expect((await screen.uav(1)).downlink).toBe("up");
  await screen.picture("simulation-cut", 1280, 720, "dark");
  await until(async () => expect((await screen.uav(2)).downlink).toBe("up"));
  expect(await word(2)).not.toMatch(/ cut$/);
});

test("a link is made slow and lossy, and good again", async () => {
  explain(station);
  await choose("Both");
  await type("For [s]", "always");
  await type("Delay [s]", "0.5");
  await type("Loss [%]", "20");
  await screen.button("Set delay and loss of UAV2").click();
  await until(async () => expect(await word(2)).toMatch(/0\.5 s delay.*20% loss/));
  await type("Delay [s]", "61");
  expect(await screen.text(".field-problem")).toMatch(/60/);
  await screen.page.keyboard.press("Escape");
  await screen.button("Restore the links of UAV2, without delay or loss").click();
  await until(async () => expect(await word(2)).not.toMatch(/delay/));
});

test("all links are cut at once, and restored", async () => {
  explain(station);
  // Not by a click on the row: the worst come first, and UAV2 has just become better.
  await screen.button("Clear").click();
  await screen.button("Cut the links of all 2 UAVs").click();
  await until(async () => {
    for (const id of [1, 2]) {
      expect(await screen.uav(id)).toMatchObject({
        downlink: "lost",
        uplink: "lost",
      });
    }
  });
  await screen.button("Restore the links of all 2 UAVs, without delay or loss").click();
  await until(async () => {
    for (const id of [1, 2])
      expect(await screen.uav(id)).toMatchObject({
        downlink: "up",
        uplink: "up",
      });
  });
});

test("the scenario is started anew after a second look", async () => {
  explain(station);
  const before_s = await elapsed_s();
  await screen.button("Restart…").click();
  await screen.button("Cancel").click();
  await screen.button("Restart…").click();
  await screen.button("Restart now").click();
  await until(async () => {
    expect(await screen.page.locator(".simulation").innerText()).toContain("Started.");
    expect(await elapsed_s()).toBeLessThan(before_s);
  }, 5000);
  await until(async () => {
    expect(await screen.text(".events")).toMatch(/simulation starts anew: Two abreast, 2 UAVs/i);
    expect(await screen.page.locator(".events .flight-start").count()).toBe(1);
    expect(await screen.text(".mode-name")).toBe("In formation");
  });
});

test("another scenario with more UAVs is chosen, read about and loaded", async () => {
  explain(station);
  await screen.button("Load another…").click();
  const choice = screen.page.locator(".scenario-choice", {
    hasText: "Four abreast",
  });
  expect(await choice.innerText()).toContain("4 UAVs");
  expect(await choice.innerText()).toContain("another fleet to load");
  await choice.locator("input").check();
  await screen.page.getByText("Four abreast starts with 4 UAVs").waitFor();
  for (const [width, height, theme] of [
    [1280, 720, "dark"],
    [1920, 1080, "light"],
  ] as const) {
    await screen.picture("simulation-load", width, height, theme);
    expect(await screen.barriers()).toEqual([]);
  }
  await screen.button("Load now").click();
  await until(async () => {
    expect(await screen.page.locator(".uav-table tbody tr[data-id]").count()).toBe(4);
    expect(await screen.text(".scenario")).toBe("Four abreast");
  }, 5000);
  await until(async () => {
    for (const id of [1, 2, 3, 4]) {
      expect(await screen.uav(id)).toMatchObject({
        downlink: "up",
        uplink: "up",
      });
      expect(Math.abs((await screen.uav(id)).forward_error_m)).toBeLessThan(30);
    }
    expect(await screen.text(".mode-name")).toBe("In formation");
  });
});

test("without a simulator the panel says so", async () => {
  explain(station);
  await station.stop("fleet-simulator");
  await screen.page.getByText("No simulator is on the bus.").waitFor();
  expect(await screen.barriers()).toEqual([]);
});

test("nothing was complained of, and no request left this machine", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
