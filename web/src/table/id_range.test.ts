import { expect, test } from "vitest";
import { parseIdRange } from "./id_range";

const kKnown = new Set([1, 2, 3, 5, 20, 35]);

test("ids and ranges select the UAVs that there are, once each and in order", () => {
  expect(parseIdRange("35, 1-3", kKnown)).toEqual({ ids: [1, 2, 3, 35] });
  expect(parseIdRange(" 2 ;2,1-2 ", kKnown)).toEqual({ ids: [1, 2] });
  expect(parseIdRange("1\u20135", kKnown)).toEqual({ ids: [1, 2, 3, 5] });
});

test.each([
  ["", /Type ids/],
  ["1-", /"1-" is no id/],
  ["x", /"x" is no id/],
  ["-3", /"-3" is no id/],
  ["1.5", /"1\.5" is no id/],
  ["9-4", /write 4-9/],
  ["1-999999999", /too long/],
  ["7-9", /No UAV/],
])("%j is refused with a sentence", (text, sentence) => {
  expect(parseIdRange(text, kKnown)).toEqual({ problem: expect.stringMatching(sentence) as string });
});
