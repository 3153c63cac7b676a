import { beforeEach, expect, test, vi } from "vitest";
import { oneOf, remembered, within } from "./remembered";

const kept = new Map<string, string>();

beforeEach(() => {
  kept.clear();
  vi.stubGlobal("localStorage", {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => kept.set(key, value),
    removeItem: (key: string) => kept.delete(key),
  });
});

test("what was chosen comes back, and the default leaves no trace", () => {
  const unit = remembered("unit", "m", oneOf("m", "ft"));
  expect(unit.value).toBe("m");
  unit.value = "ft";
  expect(remembered("unit", "m", oneOf("m", "ft")).value).toBe("ft");
  unit.value = "m";
  expect(kept.size).toBe(0);
});

test("what another version or a person left there is checked", () => {
  kept.set("skein.unit", '"furlong"');
  expect(remembered("unit", "m", oneOf("m", "ft")).value).toBe("m");
  kept.set("skein.size", "{broken");
  expect(remembered("size", 300, within(200, 500)).value).toBe(300);
  kept.set("skein.size", "9000");
  expect(remembered("size", 300, within(200, 500)).value).toBe(500);
});

test("without storage it works until the page is closed", () => {
  vi.stubGlobal("localStorage", {
    getItem: () => {
      throw new Error("denied");
    },
    setItem: () => {
      throw new Error("denied");
    },
  });
  const size = remembered("size", 300, within(200, 500));
  size.value = 400;
  expect(size.value).toBe(400);
});
