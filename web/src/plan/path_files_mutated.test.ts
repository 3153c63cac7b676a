/** Path files that somebody has damaged: each is read, into waypoints that make sense, or refused in words. */
import { DOMParser } from "@xmldom/xmldom";
import { expect, test } from "vitest";
import { randomFrom } from "../state/random_for_tests";
import { localFrame } from "../units/geodesy";
import { PathFileError } from "./path_file";
import { readPathFile, writePathFile } from "./path_files";

const kFrame = localFrame({ latitude_deg: 40.08, longitude_deg: 116.58, altitude_m: 35 });
const kDefaults = { up_m: 1000, speed_m_s: 50 };
const kPlan = {
  closed: false,
  waypoints: [0, 1, 2].map((i) => ({
    east_m: 4000 * i,
    north_m: 8000,
    up_m: 1000 + 50 * i,
    speed_m_s: 50,
    turn_radius_m: i * 300,
  })),
};
const kFiles = 1500;
/** What breaks readers: in the place of any value. */
const kValues = [
  "null",
  "true",
  '"x"',
  "-1",
  "1e999",
  "NaN",
  "{}",
  "[]",
  "[[[]]]",
  "0",
  "99999999",
  '""',
  "-0.0",
];

function mutated(text: string, random: () => number): string {
  const place = () => Math.floor(random() * text.length);
  const pick = <T>(list: readonly T[]) => list[Math.floor(random() * list.length)] as T;
  const [from, to] = [place(), place()].sort((a, b) => a - b) as [number, number];
  switch (Math.floor(random() * 6)) {
    case 0:
      return text.slice(0, from);
    case 1:
      return text.slice(0, from) + text.slice(to);
    case 2:
      return text.slice(0, to) + text.slice(from, to) + text.slice(to);
    case 3:
      return text.slice(0, from) + String.fromCharCode(Math.floor(random() * 300)) + text.slice(from + 1);
    default: {
      const values = [...text.matchAll(/-?\d+(\.\d+)?|"[^"]*"|null|true|false|\[[^[\]]*\]/g)];
      const { index = 0, 0: value = "" } = pick(values) ?? {};
      return text.slice(0, index) + pick(kValues) + text.slice(index + value.length);
    }
  }
}

/** xmldom throws what it pleases where browsers put an element into the document. */
function parse(text: string): Document {
  try {
    return new DOMParser({ onError: () => undefined }).parseFromString(
      text,
      "application/xml",
    ) as unknown as Document;
  } catch (error) {
    throw new PathFileError(String(error));
  }
}

test.each(["geojson", "kml", "plan"] as const)(
  "%s",
  (kind) => {
    const seed = Math.floor(Math.random() * 2 ** 31);
    const told = (text: string) => `seed ${seed}:\n${text}`;
    const random = randomFrom(seed);
    const good = writePathFile(kind, kPlan, [], kFrame, "Alpha");
    let refused = 0;
    for (let i = 0; i < kFiles; i += 1) {
      let text = mutated(good, random);
      if (random() < 0.3) text = mutated(text, random);
      try {
        const { waypoints } = readPathFile(text, kFrame, kDefaults, parse);
        expect(waypoints.length, told(text)).toBeGreaterThan(0);
        for (const point of waypoints)
          expect(Object.values(point).every(Number.isFinite), told(text)).toBe(true);
      } catch (error) {
        if (!(error instanceof PathFileError))
          throw new Error(`${String(error)} of ${told(text)}`, { cause: error });
        expect(error.message.length, told(text)).toBeGreaterThan(5);
        refused += 1;
      }
    }
    // Some do no harm, most do.
    expect(refused).toBeGreaterThan(kFiles / 10);
  },
  60_000,
);
