import { afterEach, expect, test } from "vitest";
import { why_no_command } from "../control/control";
import { recordingIn, replay } from "./replay";
import { Store } from "./store";

function greet(store: Store, shown: object | null): void {
  store.takeText(JSON.stringify({ type: "hello", version: "0.1.0", lcm_url: "", utime: 1, replay: shown }));
  store.takeText(JSON.stringify({ type: "complete" }));
}

afterEach(() => {
  replay.value = null;
});

test("in a replay nothing can be commanded, and again when the flight is live", () => {
  const store = new Store(() => undefined);
  greet(store, null);
  expect(why_no_command.value).toBe("");
  greet(store, { kind: "player", name: "triangle.lcm" });
  expect(why_no_command.value).toBe("This is a replay: nothing can be commanded");
  greet(store, null);
  expect(why_no_command.value).toBe("");
});

test("the page's address names the recording", () => {
  expect(recordingIn("?recording=two%20flights.lcm")).toBe("two flights.lcm");
  expect(recordingIn("?recording=")).toBeNull();
  expect(recordingIn("")).toBeNull();
});
