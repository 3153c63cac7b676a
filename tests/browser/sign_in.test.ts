/** A bridge that demands tokens: who has none sees nothing, a viewer looks on, an operator commands, and who is revoked is out. */
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Screen, until } from "./screen";
import { explain, kBin, kPageUrl, Station } from "./station";

const folder = mkdtempSync(`${tmpdir()}/skein-tokens-`);
const tokens = `${folder}/tokens.json`;
const token = (...words: string[]) =>
  execFileSync(`${kBin}/skein`, ["token", ...words, "--file", tokens], { encoding: "utf8" }).trim();
const viewer = token("new", "Vera", "--role", "viewer");
const operator = token("new", "Otto", "--role", "operator");

const station = new Station({ scenario: "roles.json", bridge: ["--tokens", tokens] });
let screen: Screen;

const field = () => screen.page.getByLabel("Token");
const signIn = async (secret: string) => {
  await field().fill(secret);
  await screen.page.keyboard.press("Enter");
};
const signOut = async () => {
  await screen.button("Settings").click();
  await screen.button("Sign out").click();
  await field().waitFor();
};

beforeAll(async () => {
  station.start();
  await station.answers();
  screen = await Screen.open();
});

afterAll(async () => {
  await screen?.close();
  await station.stopAll();
  rmSync(folder, { recursive: true });
});

test("who has no token is asked for one, and sees nothing of the fleet", async () => {
  explain(station);
  await field().waitFor();
  await until(async () => expect(await field().evaluate((it) => it === document.activeElement)).toBe(true));
  expect(await field().inputValue()).toBe("");
  await until(async () => expect(await screen.text(".pill")).toBe("Signed out"));
  await station.hears("formation-controller");
  expect(await screen.page.locator("tbody tr").count()).toBe(0);
  expect((await fetch(`${kPageUrl}api/state`)).status).toBe(401);
  for (const theme of ["dark", "light"] as const) {
    for (const [width, height] of [
      [1280, 720],
      [820, 1180],
    ] as const)
      await screen.picture("sign-in", width, height, theme);
    expect(await screen.barriers()).toEqual([]);
  }
  await screen.show(1280, 720, "dark");
});

test("a wrong token is told of beside the field", async () => {
  explain(station);
  await signIn("skein_wrong");
  await until(async () => expect(await screen.text(".sign-in .wrong-token")).toContain("opens nothing here"));
  await screen.picture("sign-in-wrong", 1280, 720, "dark");
});

test("a viewer sees the fleet, and can't command it", async () => {
  explain(station);
  await signIn(viewer);
  await screen.row(1).waitFor();
  await until(async () => expect(await screen.payload("UAV1").getAttribute("aria-disabled")).toBe("true"));
  await screen.page.reload();
  await screen.row(1).waitFor();
  await screen.button("Settings").click();
  await until(async () => expect(await screen.text(".signed-in")).toContain("Vera, viewer"));
  await screen.picture("signed-in", 1280, 720, "dark");
  await screen.page.keyboard.press("Escape");
});

test("an operator has control, by the name of the token", async () => {
  explain(station);
  await signOut();
  await signIn(operator);
  await screen.row(1).waitFor();
  await until(async () => expect(await screen.text(".control-who")).toBe("You"));
  await screen.payload("UAV1").click();
  await until(async () => expect((await screen.uav(1)).payload_on).toBe(true));
});

test("when the bridge is killed and comes back nobody has to sign in again", async () => {
  explain(station);
  await station.stop("web-bridge");
  await until(async () => expect(await screen.text(".banner")).toContain("Reconnecting"));
  station.start("web-bridge");
  await station.answers();
  await until(async () => {
    expect(await screen.page.locator(".banner").count()).toBe(0);
    expect(await screen.text(".control-who")).toBe("You");
  });
});

test("a revoked token is out at once", async () => {
  explain(station);
  token("revoke", "Otto");
  await field().waitFor();
  expect((await fetch(`${kPageUrl}api/state`)).status).toBe(401);
  await signIn(operator);
  await until(async () => expect(await screen.text(".sign-in .wrong-token")).toContain("opens nothing here"));
});

test("no request left this machine", () => {
  // Connections that are refused are in the console; that is how browsers are.
  expect(screen.complaints.filter((text) => !/live|api\/session/.test(text))).toEqual([]);
  expect(screen.strangers).toEqual([]);
});
