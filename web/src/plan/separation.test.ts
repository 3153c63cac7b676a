import { expect, test } from "vitest";
import { closestPair, placeAt } from "./separation";
import type { FlightPreview } from "./preview";

const kTrack: [number, number, number, number][] = [
  [0, 0, 0, 1000],
  [10, 500, 0, 1000],
  [20, 500, 600, 1100],
];

test("a track is met between its points, and waits at its ends", () => {
  expect(placeAt(kTrack, 5)).toEqual([250, 0, 1000]);
  expect(placeAt(kTrack, 15)).toEqual([500, 300, 1050]);
  expect(placeAt(kTrack, -5)).toEqual([0, 0, 1000]);
  expect(placeAt(kTrack, 99)).toEqual([500, 600, 1100]);
  expect(placeAt([], 5)).toBeNull();
});

test("the closest pair is where both are at that moment", () => {
  const flight = {
    least: { horizontal_m: 1, vertical_m: 1, t_s: 5, ids: [1, 2], inside_cylinder: false },
    tracks: [
      { id: 1, points: kTrack },
      { id: 2, points: [[0, 9, 9, 9]] },
    ],
  } as unknown as FlightPreview;
  expect(closestPair(flight)).toEqual([
    [250, 0, 1000],
    [9, 9, 9],
  ]);
  expect(closestPair({ ...flight, least: null })).toEqual([]);
});
