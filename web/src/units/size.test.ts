import { expect, test } from "vitest";
import { size } from "./size";

test.each([
  [0, "0 B"],
  [999, "999 B"],
  [1000, "1.0 kB"],
  [9_960, "10 kB"],
  [999_600, "1.0 MB"],
  [1_440_000, "1.4 MB"],
  [2_147_483_648, "2.1 GB"],
  [25e9, "25 GB"],
  [3e15, "3000 TB"],
])("%d bytes are %s", (bytes, text) => {
  expect(size(bytes)).toBe(text);
});
