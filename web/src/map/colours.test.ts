import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { identityOf, kIdentities } from "./colours";

type Rgb = [number, number, number];

const kTokens = readFileSync(new URL("../style/tokens.css", import.meta.url), "utf8");

function colours(theme: "dark" | "light"): Map<string, Rgb> {
  const [dark = "", light = ""] = kTokens.split(':root[data-theme="light"]');
  const block = theme === "dark" ? dark : light;
  return new Map(
    [...block.matchAll(/--([\w-]+): #(\w{6})/g)].map(([, name = "", hex = ""]) => [
      name,
      [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255) as Rgb,
    ]),
  );
}

const linear = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

/** Machado, Oliveira and Fernandes (2009), severity 1, on linear RGB. */
const kVisions: Record<string, number[][]> = {
  normal: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

/** OKLab: distances in it go with how different colours look. */
function oklab(rgb: Rgb, vision: number[][]): Rgb {
  const [r, g, b] = vision.map((row) =>
    Math.min(
      1,
      Math.max(
        0,
        row.reduce((sum, m, i) => sum + m * linear(rgb[i] ?? 0), 0),
      ),
    ),
  ) as Rgb;
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

const distance = (a: Rgb, b: Rgb) => Math.hypot(...a.map((x, i) => x - (b[i] ?? 0)));

function luminance(rgb: Rgb): number {
  const [r, g, b] = rgb.map(linear) as Rgb;
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: Rgb, b: Rgb): number {
  const [dark, light] = [luminance(a), luminance(b)].sort((x, y) => x - y) as [number, number];
  return (light + 0.05) / (dark + 0.05);
}

function named(all: Map<string, Rgb>, name: string): Rgb {
  const colour = all.get(name);
  if (colour === undefined) throw new Error(`no ${name}`);
  return colour;
}

test.each(["dark", "light"] as const)(
  "%s: everybody can tell the identities and the alerts apart",
  (theme) => {
    const all = colours(theme);
    const identities = Array.from({ length: kIdentities }, (_, i) => `identity-${i + 1}`);
    const close: string[] = [];
    for (const [vision, matrix] of Object.entries(kVisions)) {
      const lab = (name: string) => oklab(named(all, name), matrix);
      identities.forEach((a, i) => {
        for (const b of identities.slice(i + 1)) {
          if (distance(lab(a), lab(b)) < 0.12)
            close.push(`${vision}: ${a} ${b} ${distance(lab(a), lab(b)).toFixed(3)}`);
        }
      });
    }
    const lab = (name: string) => oklab(named(all, name), kVisions["normal"] ?? []);
    for (const a of identities) {
      for (const b of ["warning", "caution", "advisory"]) {
        if (distance(lab(a), lab(b)) < 0.14) close.push(`${a} ${b} ${distance(lab(a), lab(b)).toFixed(3)}`);
      }
    }
    expect(close).toEqual([]);
  },
);

test.each([
  ["dark", "text", "surface"],
  ["dark", "muted", "surface"],
  ["dark", "muted", "surface-hover"],
  ["dark", "map-text", "map-land"],
  ["dark", "accent-ink", "accent"],
  ["dark", "accent-ink", "caution"],
  ["light", "text", "surface"],
  ["light", "muted", "surface"],
  ["light", "muted", "surface-hover"],
  ["light", "map-text", "map-land"],
  ["light", "map-text", "map-sea"],
  ["light", "accent-ink", "accent"],
  ["light", "accent-ink", "caution"],
  ...(["dark", "light"] as const).flatMap((theme) =>
    ["warning", "caution", "advisory"].map((level) => [theme, level, "surface"] as const),
  ),
  ...(["dark", "light"] as const).flatMap((theme) =>
    Array.from({ length: kIdentities }, (_, i) => [theme, "map-halo", `identity-${i + 1}`] as const),
  ),
] as const)("%s: %s on %s has a contrast of 4.5 (WCAG AA)", (theme, ink, paper) => {
  const all = colours(theme);
  expect(contrast(named(all, ink), named(all, paper))).toBeGreaterThanOrEqual(4.5);
});

test("ids take the identities in turn", () => {
  expect([1, 2, 6, 7].map(identityOf)).toEqual([1, 2, 6, 1]);
});
