import { describe, expect, it } from "vitest";
import { endOf, lostText, sameWords, withLossAge } from "./mode_text";

describe("the text of a mode", () => {
  it("tells how long ago a link was lost", () => {
    expect(withLossAge("climbing 200 m (8 m to go): link of UAV3 lost", 12.7)).toBe(
      "climbing 200 m (8 m to go): link of UAV3 lost 12 s ago",
    );
    expect(withLossAge("climbing 200 m: link of UAV3, UAV5 lost; no altitude is free", 4)).toBe(
      "climbing 200 m: link of UAV3, UAV5 lost 4 s ago; no altitude is free",
    );
  });

  it("tells that it is heard again before it counts as restored", () => {
    expect(withLossAge("descending 87 m: link of UAV1 lost", 0.4)).toBe(
      "descending 87 m: link of UAV1 lost, heard again",
    );
    expect(lostText(0.4)).toBe("lost, heard again");
    expect(lostText(94)).toBe("lost 1 min 34 s");
  });

  it("is as it came when nothing is lost, or its age is not known", () => {
    expect(withLossAge("in formation", 3)).toBe("in formation");
    expect(withLossAge("climbing 200 m: link of UAV3 lost", null)).toBe("climbing 200 m: link of UAV3 lost");
  });

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
