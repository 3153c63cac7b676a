import { describe, expect, it } from "vitest";
import { lostText, withLossAge } from "./loss_text";

describe("the loss of a link", () => {
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
});
