/** The table and payloads: sorted, filtered, selected by id and by keyboard; what is on and off is what telemetry says. */
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until } from "./screen";
import { explain, Station } from "./station";

const station = new Station({ scenario: "table.json" });
let screen: Screen;

const grid = () => screen.page.getByRole("grid", { name: "Formation information" });

/** Ids from top to bottom, as they are seen. */
const shown = () =>
  grid().evaluate((table) =>
    [...table.querySelectorAll<HTMLElement>("tr[data-id]")]
      .sort((a, b) => a.getBoundingClientRect().top - b.getBoundingClientRect().top)
      .map((row) => Number(row.dataset["id"])),
  );
const selected = () =>
  grid().evaluate((table) =>
    [...table.querySelectorAll<HTMLElement>('tr[aria-selected="true"]')]
      .map((row) => Number(row.dataset["id"]))
      .sort((a, b) => a - b),
  );
/** Nobody is at the table: rows may move. */
const leave = () => screen.page.mouse.move(640, 200);

beforeAll(async () => {
  station.start();
  await station.answers();
  screen = await Screen.open();
  // High enough for twelve rows.
  await screen.page.evaluate(() => {
    localStorage.setItem("skein.layout.dock_px", "480");
  });
  await screen.page.reload();
});

afterAll(async () => {
  await screen?.close();
  await station.stopAll();
});

test("a row a UAV, with units in the heads", async () => {
  explain(station);
  await until(async () => {
    expect(await grid().getAttribute("aria-rowcount")).toBe("13");
    expect((await screen.uav(1)).downlink).toBe("up");
  });
  const heads = await grid().getByRole("columnheader").allInnerTexts();
  for (const head of ["Forward\nerror, m", "R\nm", "Tau\ns", "Altitude\nm ENU", "Speed\nm/s", "Course\n°"]) {
    expect(heads.map((text) => text.replace(/^Sort by\s*/, "").replace(/\n+/g, "\n"))).toContain(head);
  }
});

test("the worst comes first: who loses the link goes to the top, but not while somebody is at the table", async () => {
  explain(station);
  await leave();
  await screen.button("Cut the link of UAV7").click();
  // The pointer is in the table now.
  await until(async () => expect((await screen.uav(7)).downlink).toBe("lost"));
  await screen.page.getByText("Order held").waitFor();
  expect((await shown())[0]).toBe(1);
  await screen.page.evaluate(() => {
    (document.activeElement as HTMLElement | null)?.blur();
  });
  await leave();
  await until(async () => expect((await shown())[0]).toBe(7));
  expect(await screen.text('tr[data-id="7"] .mode')).toBe("Lost");
});

test("heads sort both ways and back, and columns can be hidden", async () => {
  explain(station);
  const id_head = grid().getByRole("columnheader", {
    name: "Sort by UAV",
    exact: true,
  });
  await id_head.getByRole("button").click();
  await until(async () => expect(await shown()).toEqual([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]));
  expect(await id_head.getAttribute("aria-sort")).toBe("ascending");
  await id_head.getByRole("button").click();
  await until(async () => expect((await shown())[0]).toBe(12));
  await id_head.getByRole("button").click();
  await until(async () => expect((await shown())[0]).toBe(7));

  await screen.button("Columns").click();
  await screen.page.getByRole("checkbox", { name: "Course" }).uncheck();
  await until(async () => expect(await grid().locator("td.course").count()).toBe(0));
  await screen.page.getByRole("checkbox", { name: "Course" }).check();
  await screen.page.keyboard.press("Escape");
});

test("a filter shows who is lost, a formation, or what is typed", async () => {
  explain(station);
  const show = screen.page.getByRole("combobox", { name: "Show" });
  await show.selectOption("Link lost");
  await until(async () => expect(await shown()).toEqual([7]));
  await show.selectOption("Bravo");
  await until(async () => expect(await shown()).toEqual([9, 10, 11, 12]));
  await show.selectOption("All");
  const find = screen.page.getByRole("searchbox");
  await find.fill("uav1");
  await until(async () => expect(await shown()).toEqual([1, 10, 11, 12]));
  await find.fill("nobody");
  await screen.page.getByText("No UAV is like that").waitFor();
  await find.fill("");
});

test("typed ids select; the map and the charts follow, and nonsense is answered with a sentence", async () => {
  explain(station);
  const range = screen.page.getByRole("textbox", { name: /Select ids/ });
  await range.fill("1-3, 9");
  await range.press("Enter");
  await until(async () => expect(await selected()).toEqual([1, 2, 3, 9]));
  await range.fill("3-1");
  await range.press("Enter");
  await until(async () => expect(await screen.page.locator(".problem").innerText()).toContain("write 1-3"));
  await range.fill("");
  await screen.page.getByRole("tab", { name: "Charts" }).click();
  await until(async () =>
    expect(await screen.page.locator(".curve-legend li").allInnerTexts()).toEqual([
      "Selected:",
      "UAV1",
      "UAV2",
      "UAV3",
      "UAV9",
    ]),
  );
  await screen.page.getByRole("tab", { name: "Table" }).click();
});

test("a click selects one, Ctrl adds, Shift takes all between", async () => {
  explain(station);
  const name = (id: number) => screen.row(id).locator(".uav-name");
  await screen.page.getByRole("combobox", { name: "Order" }).selectOption("By id");
  await until(async () => expect((await shown())[0]).toBe(1));
  await name(4).click();
  await until(async () => expect(await selected()).toEqual([4]));
  await name(6).click({ modifiers: ["Shift"] });
  await until(async () => expect(await selected()).toEqual([4, 5, 6]));
  await name(9).click({ modifiers: ["Control"] });
  await until(async () => expect(await selected()).toEqual([4, 5, 6, 9]));
  // A click on the map's empty part or on a UAV is the map's business; the count here follows the selection.
  expect(await screen.text(".selected-count")).toBe("4 selected");
});

test("with the keyboard: arrows move, Space selects, Ctrl+A takes all, Escape none, Enter centres the map", async () => {
  explain(station);
  await screen.page.evaluate(() => {
    (document.activeElement as HTMLElement | null)?.blur();
  });
  await screen.page.keyboard.press("t");
  await until(async () =>
    expect(await grid().evaluate((table) => table === document.activeElement)).toBe(true),
  );
  await screen.page.keyboard.press("Escape");
  await until(async () => expect(await selected()).toEqual([]));
  await screen.page.keyboard.press("Home");
  await screen.page.keyboard.press("ArrowDown");
  await screen.page.keyboard.press("Space");
  await until(async () => expect(await selected()).toEqual([2]));
  await screen.page.keyboard.press("Shift+ArrowDown");
  await until(async () => expect(await selected()).toEqual([2, 3]));
  await screen.page.keyboard.press("Control+a");
  await until(async () => expect((await selected()).length).toBe(12));
  expect(await grid().getAttribute("aria-activedescendant")).toBe("uav-row-3");
  const centre = () => screen.page.locator(".leaflet-map-pane").getAttribute("style");
  const before = await centre();
  await screen.page.keyboard.press("End");
  await screen.page.keyboard.press("Enter");
  await until(async () => expect(await centre()).not.toBe(before));
  await screen.page.keyboard.press("Escape");
  await until(async () => expect(await selected()).toEqual([]));
});

test("payloads of a selection follow, and who is lost is named", async () => {
  explain(station);
  const range = screen.page.getByRole("textbox", { name: /Select ids/ });
  await range.fill("5-7, 12");
  await range.press("Enter");
  await until(async () => expect(await selected()).toEqual([5, 6, 7, 12]));
  await screen.button("Payload on: 3 of the selected carry one").click();
  await until(async () => {
    for (const id of [5, 6]) expect((await screen.uav(id)).payload_on).toBe(true);
  });
  // UAV7 hears nothing: its switch still says off, and that it is waited for.
  expect((await screen.uav(7)).payload_on).toBe(false);
  await screen.row(7).locator('[data-phase="pending"]').waitFor();
  await screen.picture("table-payload-pending", 1280, 720, "dark");
  const sentence = screen.page.locator(".table-panel .payload-message");
  await until(async () =>
    expect(await sentence.innerText()).toMatch(/^UAV7: .* on 5 s .* data link is lost\.$/),
  );
  expect(await screen.row(7).locator('[data-phase="late"]').count()).toBe(1);
});

test("the payload panel counts by telemetry, for the selected, all or a formation", async () => {
  explain(station);
  await screen.button("Payload").click();
  const panel = screen.page.locator(".payload-panel");
  await panel.getByRole("radio", { name: "Bravo" }).check();
  await until(async () => expect(await panel.innerText()).toContain("3 of 4 carry a payload."));
  await screen.button("Switch on the payloads").click();
  const count = (name: string) =>
    panel
      .locator("dl > div", { hasText: new RegExp(`^${name}`) })
      .locator("dd")
      .innerText();
  await until(async () => expect([await count("On"), await count("Off")]).toEqual(["3", "0"]));
  await panel.getByRole("radio", { name: "All" }).check();
  await until(async () => {
    expect([await count("On"), await count("Off"), await count("Not followed")]).toEqual(["5", "6", "1"]);
  });
  await screen.picture("table-payload", 1920, 1080, "dark");
  for (const theme of ["dark", "light"] as const) {
    await screen.picture("table-payload", 1280, 720, theme);
    expect(await screen.barriers()).toEqual([]);
  }
});

test("nothing was complained of, and no request left this machine", () => {
  expect(screen.complaints).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
