import { afterEach, expect, test } from "vitest";
import { why_no_command } from "../control/control";
import { recordingIn, replay } from "./replay";
import { Store } from "./store";

const hello = (shown: object | null) =>
  JSON.stringify({ type: "hello", version: "0.1.0", lcm_url: "", utime: 1, replay: shown });

afterEach(() => {
  replay.value = null;
});

test("in a replay nothing can be commanded, and again when the flight is live", () => {
  const store = new Store(() => undefined);
  store.takeText(hello(null));
  expect(why_no_command.value).toBe("");
  store.takeText(hello({ kind: "player", name: "triangle.lcm" }));
  expect(why_no_command.value).toBe("This is a replay: nothing can be commanded");
  store.takeText(hello(null));
  expect(why_no_command.value).toBe("");
});

test("the page's address names the recording", () => {
  expect(recordingIn("?recording=two%20flights.lcm")).toBe("two flights.lcm");
  expect(recordingIn("?recording=")).toBeNull();
  expect(recordingIn("")).toBeNull();
});
