import { expect, test } from "vitest";
import { localFrame } from "../units/geodesy";
import { latitudeOf, mercatorX, mercatorY, pixelOf, pixelsPerMetre, type View } from "./view";

const kView: View = { scale_px: 256 * 2 ** 12, left_px: 0, top_px: 0, width_px: 1000, height_px: 600 };

test("Mercator has its known points, and an inverse", () => {
  expect(mercatorX(-180)).toBe(0);
  expect(mercatorX(180)).toBe(1);
  expect(mercatorY(0)).toBeCloseTo(0.5, 12);
  expect(mercatorY(85.0511287798066)).toBeCloseTo(0, 12);
  for (const latitude of [-80, -33.9, 0, 40.08, 78])
    expect(latitudeOf(mercatorY(latitude))).toBeCloseTo(latitude, 10);
});

test("a kilometre east and north has the length that the scale says", () => {
  const frame = localFrame({ latitude_deg: 40.08, longitude_deg: 116.58, altitude_m: 0 });
  const per_metre = pixelsPerMetre(kView, 40.08);
  const origin = pixelOf(kView, frame, 0, 0, 0);
  const east = pixelOf(kView, frame, 1000, 0, 0);
  const north = pixelOf(kView, frame, 0, 1000, 0);
  // The map is of the sphere, the frame of the ellipsoid: they differ by less than 0.5%.
  expect((east.x - origin.x) / per_metre / 1000).toBeCloseTo(1, 2);
  expect((origin.y - north.y) / per_metre / 1000).toBeCloseTo(1, 2);
  expect(north.x).toBeCloseTo(origin.x, 3);
});
