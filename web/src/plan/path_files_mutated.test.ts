/**
 * Path files that somebody has damaged: each is read, into waypoints that make sense, or refused in words.
 * SKEIN_FUZZ_SECONDS: how long each kind is tried (scripts/soak fuzz); kFiles files otherwise.
 */
import { existsSync, readdirSync, readFileSync } from "node:fs";
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
const kLong_s = Number(process.env.SKEIN_FUZZ_SECONDS ?? 0);
/** Files that were read although something had been done to them: damaged further, they get deeper than the first. */
const kMostKept = 500;
const kFolder = `${import.meta.dirname}/../../../tests/fuzz`;
const kKinds = ["geojson", "kml", "plan"] as const;
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

/** What is wrong with how a file was taken; empty when it was read, or refused in words, as it should. */
function take(text: string): { read: boolean; wrong: string } {
  try {
    const { waypoints } = readPathFile(text, kFrame, kDefaults, parse);
    const finite = waypoints.every((point) => Object.values(point).every(Number.isFinite));
    return { read: true, wrong: waypoints.length > 0 && finite ? "" : JSON.stringify(waypoints) };
  } catch (error) {
    if (!(error instanceof PathFileError)) return { read: false, wrong: String(error) };
    return { read: false, wrong: error.message.length > 5 ? "" : "refused without words" };
  }
}

const seedsOf = (kind: (typeof kKinds)[number]) => [
  writePathFile(kind, kPlan, [], kFrame, "Alpha"),
  ...["seeds", "findings"]
    .map((which) => `${kFolder}/${which}/path_files`)
    .filter(existsSync)
    .flatMap((folder) => readdirSync(folder).map((name) => `${folder}/${name}`))
    .filter((file) => file.endsWith(`.${kind}`))
    .map((file) => readFileSync(file, "utf8")),
];

test.each(kKinds)(
  "%s",
  (kind) => {
    const seed = Math.floor(Math.random() * 2 ** 31);
    const random = randomFrom(seed);
    const kept = seedsOf(kind);
    for (const text of kept) expect(take(text).wrong, text).toBe("");
    const first = kept.length;
    const end_ms = performance.now() + 1000 * kLong_s;
    let [refused, files] = [0, 0];
    for (; kLong_s > 0 ? performance.now() < end_ms : files < kFiles; files += 1) {
      let text = mutated(kept[Math.floor(random() * kept.length)] ?? "", random);
      if (random() < 0.3) text = mutated(text, random);
      const { read, wrong } = take(text);
      expect(wrong, `seed ${seed}, file ${files}:\n${text}`).toBe("");
      if (!read) refused += 1;
      else if (kept.length < kMostKept) kept.push(text);
      else kept[first + Math.floor(random() * (kMostKept - first))] = text;
    }
    // Some do no harm, many do.
    expect(refused).toBeGreaterThan(files / 10);
    if (kLong_s > 0) process.stdout.write(`${kind}: ${files} files, ${refused} of them refused\n`);
  },
  60_000 + 1000 * kLong_s,
);
