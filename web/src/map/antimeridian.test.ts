import { expect, test } from "vitest";
import { flatRing, unrolled } from "./antimeridian";

test("a line over the date line runs on, both ways", () => {
  const east = [
    [179, 10],
    [-179, 11],
    [-178, 12],
  ];
  expect(unrolled(east)).toEqual([
    [179, 10],
    [181, 11],
    [182, 12],
  ]);
  const west = [
    [-179, 10],
    [179, 11],
    [-179, 12],
  ];
  expect(unrolled(west)).toEqual([
    [-179, 10],
    [-181, 11],
    [-179, 12],
  ]);
});

test("a ring that stays on one side is left as it is", () => {
  const ring = [
    [0, 0],
    [10, 0],
    [10, 10],
    [0, 0],
  ];
  expect(flatRing(ring)).toEqual(ring);
});

test("a ring around the south pole is closed along the pole", () => {
  const ring = [
    [-180, -70],
    [-90, -75],
    [0, -70],
    [90, -75],
    [179, -70],
    [-180, -70],
  ];
  expect(flatRing(ring).slice(-4)).toEqual([
    [180, -70],
    [180, -90],
    [-180, -90],
    [-180, -70],
  ]);
});
