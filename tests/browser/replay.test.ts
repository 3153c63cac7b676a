/** A flight recorded by lcm-logger and played by lcm-logplayer: the page says that it is a replay, and commands nothing. */
import { spawn, spawnSync, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, expect, onTestFailed, test } from "vitest";
import { Screen, until } from "./screen";
import { kBin, kLcmUrl, kPageUrl, kPort, Station } from "./station";

const kReplay = fileURLToPath(new URL("../../scripts/replay", import.meta.url));
const kWhy = "This is a replay: nothing can be commanded";
/** Some six seconds of two UAVs. */
const kEnoughBytes = 120_000;

const folder = mkdtempSync(`${tmpdir()}/skein-replay-`);
const log = `${folder}/roles.lcm`;
let replay: ChildProcess;
let spy: ChildProcess;
let screen: Screen;
let said = "";
let heard = "";

async function end(child: ChildProcess | undefined, signal: NodeJS.Signals): Promise<void> {
  if (child === undefined || child.exitCode !== null) return;
  const ended = once(child, "exit");
  child.kill(signal);
  await ended;
}

function explain(): void {
  onTestFailed(() => {
    process.stderr.write(`${said}\n`);
  });
}

/** A flight in which somebody has commanded. */
async function record(): Promise<void> {
  const logger = spawn("lcm-logger", ["--quiet", `--lcm-url=${kLcmUrl}`, log], { stdio: "ignore" });
  const station = new Station({ scenario: "roles.json" });
  station.start("fleet-simulator", "formation-controller", "collision-monitor");
  await until(() => {
    const { status } = spawnSync(`${kBin}/skein`, ["--lcm-url", kLcmUrl, "payload", "on", "UAV1"]);
    expect(status).toBe(0);
  });
  await until(() => expect(statSync(log).size).toBeGreaterThan(kEnoughBytes));
  await station.stopAll();
  await end(logger, "SIGTERM");
}

beforeAll(async () => {
  await record();
  spy = spawn(`${kBin}/skein`, ["--lcm-url", kLcmUrl, "spy", "--json"], {
    stdio: ["ignore", "pipe", "inherit"],
  });
  spy.stdout?.on("data", (chunk: Buffer) => {
    heard += chunk.toString();
  });
  replay = spawn(kReplay, [log, "--speed", "2", "--port", kPort, "--lcm-url", kLcmUrl]);
  for (const stream of [replay.stdout, replay.stderr]) {
    stream?.on("data", (chunk: Buffer) => {
      said += chunk.toString();
    });
  }
  await until(() => expect(said).toContain(kPageUrl.replace(/\/$/, "")));
  screen = await Screen.open();
  await screen.row(1).waitFor();
});

afterAll(async () => {
  await screen?.close();
  await end(replay, "SIGINT");
  await end(spy, "SIGINT");
  rmSync(folder, { recursive: true, force: true });
});

test("the page says that it is a replay, of what and how fast, in no colour of an alert", async () => {
  explain();
  const banner = screen.page.getByRole("region", { name: "Replay" });
  await banner.waitFor();
  const text = await banner.innerText();
  expect(text).toContain("REPLAY");
  expect(text).toContain("roles.lcm, 2 times as fast");
  const colours = await banner.evaluate((element) => {
    const probe = document.createElement("i");
    element.append(probe);
    const resolve = (name: string) => {
      probe.style.color = `var(${name})`;
      return getComputedStyle(probe).color;
    };
    const alerts = ["--warning", "--caution", "--advisory"].map(resolve);
    probe.remove();
    return { banner: getComputedStyle(element).backgroundColor, alerts };
  });
  expect(colours.alerts).not.toContain(colours.banner);
});

test("nothing on the page commands, and every control says why", async () => {
  explain();
  expect(await screen.payload("UAV1").getAttribute("aria-disabled")).toBe("true");
  expect(await screen.payload("UAV1").getAttribute("title")).toBe(`Payload of UAV1: ${kWhy}`);
  await screen.payload("UAV1").click({ force: true });
  expect(await screen.page.locator(".hold-all").getAttribute("aria-disabled")).toBe("true");
  expect(await screen.page.locator(".control-pill").count()).toBe(0);
});

test("the bridge refuses a command that comes past the page", async () => {
  explain();
  const answer = await fetch(`${kPageUrl}api/command`, {
    method: "POST",
    body: JSON.stringify({ channel: "CMD_PAYLOAD", body: { vehicle_ids: [1], on: false } }),
  });
  expect(answer.status).toBe(409);
  expect(await answer.json()).toEqual({
    accepted: false,
    reason: "this is a replay: nothing can be commanded",
  });
});

test("the flight is seen and no command is heard on the bus", async () => {
  explain();
  await until(() => expect(said).toContain("That was the end of the recording"));
  expect(heard).toContain('"FLEET_STATE"');
  expect(heard).toContain('"ACK"');
  expect(heard).not.toContain('"CMD_');
  expect((await screen.uav(1)).payload_on).toBe(true);
});

test("it can be read by everybody", async () => {
  for (const theme of ["dark", "light"] as const) {
    await screen.picture("replay", 1280, 720, theme);
    expect(await screen.barriers()).toEqual([]);
  }
  await screen.picture("replay", 768, 1024, "dark");
  expect(screen.complaints).toEqual([]);
});
