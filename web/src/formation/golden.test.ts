/** The same files are held against cpp/core by tests/unit/core/golden_test.cc. */
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { isControl, kControls, kGains } from "./gains";
import { isShape, kShapes, shapeSlots } from "./shapes";

function golden(name: string): string[][] {
  const text = readFileSync(new URL(`../../../tests/golden/${name}`, import.meta.url), "utf8");
  return text
    .trim()
    .split("\n")
    .slice(1)
    .map((line) => line.split(","));
}

test("slots of every shape are those of cpp/core", () => {
  const rows = golden("shapes.csv");
  expect(new Set(rows.map(([shape]) => shape))).toEqual(new Set(kShapes));
  for (const [shape = "", count, spacing_m, lead_m, index, forward_m, left_m] of rows) {
    if (!isShape(shape)) throw new Error(`there is no shape ${shape}`);
    const slot = shapeSlots(shape, Number(count), Number(spacing_m), Number(lead_m))[Number(index)];
    expect(slot?.forward_m, `${shape} ${count}/${index}`).toBeCloseTo(Number(forward_m), 5);
    expect(slot?.left_m, `${shape} ${count}/${index}`).toBeCloseTo(Number(left_m), 5);
    expect(slot?.up_m).toBe(0);
  }
});

test("gains, presets and ranges are those of cpp/core", () => {
  const rows = golden("gains.csv");
  for (const control of kControls) {
    const known = rows.filter(([of_control]) => of_control === control);
    expect(kGains[control].map(({ name }) => name)).toEqual(known.map(([, name]) => name));
  }
  for (const [control = "", name, preset, least, most] of rows) {
    if (!isControl(control)) throw new Error(`there is no control ${control}`);
    expect(kGains[control].find((gain) => gain.name === name)).toMatchObject({
      preset: Number(preset),
      least: Number(least),
      most: most === "" ? Infinity : Number(most),
    });
  }
});
