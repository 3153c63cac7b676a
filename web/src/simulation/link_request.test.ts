import { expect, test } from "vitest";
import type { BusEvent } from "../link/messages";
import { forEach, lastWords, linkBody, qualityProblem, type LinkRequest } from "./link_request";

const request: LinkRequest = {
  direction: "down",
  kind: "frozen",
  for_s: 20,
  delay_s: 0.5,
  jitter_s: 0.2,
  loss: 0.3,
};

test("a cut takes direction, kind and time; a restored link is whole in both directions", () => {
  expect(linkBody(3, "cut", request)).toEqual({
    vehicle_id: 3,
    mode: "frozen",
    uplink: false,
    downlink: true,
    duration_s: 20,
  });
  expect(linkBody(3, "restore", request)).toEqual({
    vehicle_id: 3,
    mode: "up",
    uplink: true,
    downlink: true,
  });
});

test("a lossy link is up, with delay, jitter and loss", () => {
  expect(linkBody(3, "quality", { ...request, direction: "both" })).toEqual({
    vehicle_id: 3,
    mode: "up",
    uplink: true,
    downlink: true,
    delay_s: 0.5,
    jitter_s: 0.2,
    loss: 0.3,
    duration_s: 20,
  });
  expect(qualityProblem(request)).toBe("");
  expect(qualityProblem({ ...request, delay_s: 59.9 })).toMatch(/60 s/);
});

test("all are asked a few at a time, and those that were refused are named", async () => {
  let [waiting, most] = [0, 0];
  const ids = Array.from({ length: 40 }, (_, i) => i + 1);
  const outcome = await forEach(
    ids,
    async (id) => {
      waiting += 1;
      most = Math.max(most, waiting);
      await Promise.resolve();
      waiting -= 1;
      return id % 20 === 0 ? { accepted: false, reason: "no" } : { accepted: true, reason: "" };
    },
    (id) => `UAV${id}`,
  );
  expect(most).toBeLessThanOrEqual(12);
  expect(outcome).toEqual({ accepted: false, reason: "UAV20, UAV40: no" });
});

test("when nobody answers, the rest are spared", async () => {
  let asked = 0;
  await forEach(
    Array.from({ length: 40 }, (_, i) => i),
    () => {
      asked += 1;
      return Promise.resolve({ accepted: false, reason: "nobody answered" });
    },
    String,
  );
  expect(asked).toBe(12);
});

test("the last word on a link counts, and none of an earlier flight", () => {
  const event = (utime: number, code: string, vehicle_id: number) =>
    ({ utime, code, vehicle_id, text: code }) as BusEvent;
  const words = lastWords(
    [
      event(50, "link_set", 2),
      event(40, "link_cut_ended", 1),
      event(35, "payload_on", 1),
      event(30, "link_cut", 1),
      event(5, "link_cut", 3),
    ],
    10,
  );
  expect([...words].map(([id, { code }]) => [id, code])).toEqual([
    [2, "link_set"],
    [1, "link_cut_ended"],
  ]);
});
