import { expect, test } from "vitest";
import { missingFor, nodeStates } from "./nodes";

test("a node is heard, has fallen silent, or was never there", () => {
  const nodes = nodeStates(
    new Map([
      ["fleet-simulator", {}],
      ["collision-monitor", {}],
    ]),
    ["collision-monitor"],
  );
  expect(nodes.map(({ name, state }) => [name, state])).toEqual([
    ["fleet-simulator", "heard"],
    ["formation-controller", "never"],
    ["collision-monitor", "silent"],
  ]);
});

test("a flying fleet misses a controller and a monitor that were never heard, and no simulator", () => {
  expect(missingFor(nodeStates(new Map(), []))).toEqual(["formation-controller", "collision-monitor"]);
  expect(missingFor(nodeStates(new Map([["formation-controller", {}]]), ["formation-controller"]))).toEqual([
    "collision-monitor",
  ]);
});
