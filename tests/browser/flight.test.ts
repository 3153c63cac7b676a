/** A person at the page: sees the fleet, cuts a link, sees what the station does about it, restores it. One flight, in order. */
import { afterAll, beforeAll, expect, test, vi } from "vitest";
import { Screen } from "./screen";
import { explain, Station } from "./station";

const station = new Station({ scenario: "flight.json" });
let screen: Screen;

const until = (what: () => Promise<void> | void, timeout: number) =>
  vi.waitFor(what, { timeout, interval: 100 });
const altitude_m = async (id: number) => (await screen.uav(id)).altitude_m;

/** Tests build on one another: what the nodes said tells why one failed. */
beforeAll(async () => {
  station.start("web-bridge");
  await station.answers();
  screen = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  await station.stopAll();
});

test("with no fleet on the bus, the page says what it waits for and how to start it", async () => {
  explain(station);
  const card = screen.page.locator(".first-run");
  await card.waitFor();
  expect(await card.innerText()).toContain("Waiting for a fleet");
  expect(await card.innerText()).toContain("scripts/run");
  expect(await screen.text(".pill")).toBe("No fleet yet");
  await screen.picture("first-run", 1280, 720, "dark");
});

test("three UAVs come, fill the table and move on the map", async () => {
  explain(station);
  station.start("fleet-simulator", "formation-controller", "collision-monitor");
  await until(async () => expect(await screen.page.locator("tbody tr").count()).toBe(3), 15_000);
  await until(async () => expect(await screen.text(".pill")).toBe("Live"), 15_000);
  expect(await screen.page.locator(".first-run").count()).toBe(0);

  // The map fits itself to the fleet until it knows its slots; from here on it stands still.
  await screen.page.locator(".mode-card").waitFor();
  await screen.show(1280, 720, "dark");
  const before = new Map<number, { x: number; y: number }>();
  for (const id of [1, 2, 3]) {
    await until(async () => {
      const seen = await screen.symbol(id);
      expect(seen).not.toBeNull();
      if (seen !== null) before.set(id, seen);
    }, 10_000);
  }
  for (const id of [1, 2, 3]) {
    // They fly north, up the screen.
    await until(async () => {
      expect((before.get(id)?.y ?? 0) - ((await screen.symbol(id))?.y ?? Infinity)).toBeGreaterThan(4);
    }, 10_000);
  }
});

test("the table tells link, slot, neighbour and motion of each, and the card the mode", async () => {
  explain(station);
  await until(async () => {
    for (const id of [1, 2, 3]) {
      const uav = await screen.uav(id);
      expect(uav).toMatchObject({
        level: "Clear",
        downlink: "up",
        uplink: "up",
      });
      expect(Math.abs(uav.forward_error_m)).toBeLessThan(10);
      expect(Math.abs(uav.altitude_m - 1000)).toBeLessThan(3);
      expect(Math.abs(uav.speed_m_s - 50)).toBeLessThan(3);
    }
    expect(await screen.text(".mode-name")).toBe("In formation");
  }, 60_000);
  expect(await screen.row(1).innerText()).toContain("000"); // course: north
});

test("a payload is switched from the page, and shown on when telemetry says so", async () => {
  explain(station);
  await screen.payload("UAV2").click();
  await until(async () => expect((await screen.uav(2)).payload_on).toBe(true), 10_000);
  expect((await screen.uav(1)).payload_on).toBe(false);
  await screen.payload("UAV2").press("Space");
  await until(async () => expect((await screen.uav(2)).payload_on).toBe(false), 10_000);
});

test("after a cut from the page the chain breaks and the others climb 200 m", async () => {
  explain(station);
  await screen.page.keyboard.press("f");
  await screen.page.getByRole("tab", { name: "Events" }).click();
  await screen.button("Cut the link of UAV3").click();
  await until(async () => expect((await screen.uav(3)).downlink).toBe("lost"), 15_000);
  // Found within 5 s of the cut, whatever this machine is busy with; times on the screen are whole seconds.
  expect(
    (await screen.eventTime_s("link_lost")) - (await screen.eventTime_s("link_cut")),
  ).toBeLessThanOrEqual(5);
  await until(async () => {
    expect(await screen.text(".mode-card")).toMatch(/UAV3/);
    expect(await screen.text(".events")).toMatch(/UAV3/);
  }, 10_000);
  expect(await screen.text(".summary")).toContain("1 link lost");
  await until(async () => {
    expect(await altitude_m(1)).toBeGreaterThan(1190);
    expect(await altitude_m(2)).toBeGreaterThan(1190);
  }, 45_000);
  expect(Math.abs((await altitude_m(3)) - 1000)).toBeLessThan(5);
  await screen.picture("link-lost", 1280, 720, "dark");
  await screen.picture("link-lost", 1920, 1080, "light");
});

test("after the link is restored all are in formation again, where they were", async () => {
  explain(station);
  await screen.button("Restore the link of UAV3").click();
  await until(async () => {
    expect(await screen.uav(3)).toMatchObject({ downlink: "up", uplink: "up" });
  }, 15_000);
  await until(async () => {
    for (const id of [1, 2, 3]) expect(Math.abs((await altitude_m(id)) - 1000)).toBeLessThan(3);
    expect(await screen.text(".mode-name")).toBe("In formation");
  }, 90_000);
});

test("the page fits its window in every size and theme, without scrolling", async () => {
  explain(station);
  for (const theme of ["dark", "light"] as const) {
    for (const [width, height] of [
      [1280, 720],
      [1920, 1080],
    ] as const) {
      await screen.picture("in-formation", width, height, theme);
      const overflow = await screen.page.evaluate(() => {
        const root = document.documentElement;
        const table = document.querySelector(".table-scroll");
        return {
          page: [root.scrollWidth - innerWidth, root.scrollHeight - innerHeight],
          table:
            table === null
              ? null
              : [table.scrollWidth - table.clientWidth, table.scrollHeight - table.clientHeight],
        };
      });
      expect(overflow).toEqual({ page: [0, 0], table: [0, 0] });
    }
  }
  await screen.resize(1280, 720);
});

test("axe finds no barrier in either theme", async () => {
  explain(station);
  for (const theme of ["dark", "light"] as const) {
    await screen.show(1280, 720, theme);
    expect(await screen.barriers()).toEqual([]);
  }
});

test("every control is reached by keyboard, and the focus is seen", async () => {
  explain(station);
  await screen.page.evaluate(() => {
    (document.activeElement as HTMLElement | null)?.blur();
  });
  const reached = new Set<string>();
  for (let i = 0; i < 80; i += 1) {
    await screen.page.keyboard.press("Tab");
    const focus = await screen.page.evaluate(() => {
      const element = document.activeElement;
      if (element === null || element === document.body) return null;
      // A radio button is hidden: its label shows the focus.
      const hidden = element instanceof HTMLInputElement && element.type === "radio";
      const shown = (hidden ? element.nextElementSibling : null) ?? element;
      return {
        name:
          element.getAttribute("aria-label") ?? element.getAttribute("title") ?? element.textContent ?? "",
        outlined: getComputedStyle(shown).outlineStyle !== "none",
      };
    });
    if (focus === null) continue;
    expect(focus.outlined, focus.name).toBe(true);
    reached.add(focus.name);
  }
  for (const name of [
    "Fit the map to the fleet",
    "Follow the fleet",
    "Formation information",
    "Payload of UAV1",
    "Cut the link of UAV1",
    "Restore the link of UAV1",
  ]) {
    expect([...reached]).toContain(name);
  }
});

test("nothing was complained of, and no request left this machine", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});

test("when the bridge goes the page says so, greys out, and comes back by itself", async () => {
  explain(station);
  await screen.page.keyboard.type("kGu");
  await station.stop("web-bridge");
  await screen.page.locator(".recording-pill").waitFor({ state: "detached" });
  // The field went with the connection: what is typed on is not taken for shortcuts, such as that of the editor.
  await screen.page.keyboard.type("esture");
  expect(await screen.page.locator(".drawer").count()).toBe(0);
  await until(async () => {
    expect(await screen.text(".pill")).toBe("Reconnecting…");
    expect(await screen.text(".banner")).toContain("The fleet is shown as it was at");
    expect(await screen.page.locator(".app.stale").count()).toBe(1);
  }, 10_000);
  await screen.picture("reconnecting", 1280, 720, "dark");
  station.start("web-bridge");
  await until(async () => {
    expect(await screen.text(".pill")).toBe("Live");
    expect(await screen.page.locator(".app.stale").count()).toBe(0);
  }, 15_000);
});

test("a command that nobody obeys is refused beside its button", async () => {
  explain(station);
  // The bridge has been started anew: until it has heard the simulator the page takes the links' buttons away.
  await station.hears("fleet-simulator");
  await screen.button("Cut the link of UAV1").waitFor();
  await station.stop("fleet-simulator");
  await screen.button("Cut the link of UAV1").click();
  const refusal = screen.page.locator(".refusal");
  await refusal.waitFor({ timeout: 10_000 });
  expect(await refusal.innerText()).toMatch(/answered CMD_LINK within 2 s/);
  await until(async () => expect(await screen.text(".banner")).toContain("No telemetry for"), 10_000);
  await screen.picture("refused", 1280, 720, "light");
  await screen.button("Dismiss").click();
  await refusal.waitFor({ state: "detached" });
});
