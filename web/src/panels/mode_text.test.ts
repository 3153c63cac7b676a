import { describe, expect, it } from "vitest";
import { endOf, sameWords } from "./mode_text";

describe("the text of a mode", () => {
  it("says what it waits for when no time is known", () => {
    expect(endOf(2, false)).toBe("until the link is back");
    expect(endOf(4, true)).toBe("until Resume");
    expect(endOf(4, false)).toBe("until there is a path");
    expect(endOf(1, false)).toBe("");
  });

  it("is not shown when it only repeats the mode", () => {
    expect(sameWords("in formation", "In formation")).toBe(true);
    expect(sameWords("in formation; not all UAVs are heard", "In formation")).toBe(false);
  });
});
