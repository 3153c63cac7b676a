import { expect, test } from "vitest";
import { localFrame } from "./geodesy";

// latitude, longitude, altitude of the origin; east, north, up; latitude, longitude by GeographicLib 2.1.2 (LocalCartesian::Reverse).
const kKnown = [
  [40.08, 116.58, 0, 0, 0, 0, 40.08, 116.58],
  [40.08, 116.58, 0, 1000, 3000, 800, 40.107014166951, 116.59172730377],
  [40.08, 116.58, 0, -25000, 40000, 1000, 40.439794991741, 116.28539269897],
  [40.08, 116.58, 0, 150000, -90000, 2500, 39.256815974042, 118.316808089956],
  [-33.9461, 151.1772, 6, 1000, 3000, 800, -33.919056721999, 151.188012680498],
  [-33.9461, 151.1772, 6, -25000, 40000, 1000, -33.585242681274, 150.90794327203],
  [78.2461, 15.4656, 28, 150000, -90000, 2500, 77.369940097458, 21.615558495049],
  [78.2461, 15.4656, 28, 5, -5, 0, 78.246055216161, 15.465819780172],
  [0, 179.9, 1000, -25000, 40000, 1000, 0.361625983593, 179.675492727362],
] as const;

test.each(kKnown)(
  "origin %f %f %f, east %f north %f up %f lies where GeographicLib says",
  (latitude_deg, longitude_deg, altitude_m, east, north, up, expected_latitude, expected_longitude) => {
    const at = localFrame({ latitude_deg, longitude_deg, altitude_m }).toLatLon(east, north, up);
    expect(at.latitude_deg).toBeCloseTo(expected_latitude, 9);
    expect(at.longitude_deg).toBeCloseTo(expected_longitude, 9);
  },
);

test("longitude runs on across the date line", () => {
  const at = localFrame({ latitude_deg: 0, longitude_deg: 179.9, altitude_m: 1000 }).toLatLon(
    150000,
    -90000,
    2500,
  );
  expect(at.longitude_deg).toBeCloseTo(360 - 178.753514026827, 9);
  expect(at.latitude_deg).toBeCloseTo(-0.813201828506, 9);
});

test("a place on the map goes into the local frame and comes back", () => {
  const frame = localFrame({ latitude_deg: 47.26, longitude_deg: 11.34, altitude_m: 581 });
  for (const [latitude_deg, longitude_deg, height_m] of [
    [47.26, 11.34, 581],
    [47.5, 11.1, 2000],
    [46.2, 12.9, 0],
  ] as const) {
    const { east_m, north_m, up_m } = frame.toEnu(latitude_deg, longitude_deg, height_m);
    const again = frame.toLatLon(east_m, north_m, up_m);
    expect(again.latitude_deg).toBeCloseTo(latitude_deg, 9);
    expect(again.longitude_deg).toBeCloseTo(longitude_deg, 9);
  }
  expect(frame.toEnu(47.26, 11.34, 1581).up_m).toBeCloseTo(1000, 6);
});
