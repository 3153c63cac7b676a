import { describe, expect, it } from "vitest";
import {
  acknowledge,
  acknowledgeAll,
  countdown,
  countsOf,
  countsText,
  groupsOf,
  kAcknowledged,
  kEnded,
  kOver,
  kShelved,
  kUnacknowledged,
  shelve,
  wantsAcknowledgement,
} from "./alarm_list";
import { alarm, listOf } from "./list_for_tests";

const kList = listOf([
  alarm(4, kUnacknowledged),
  alarm(1, kAcknowledged, 2),
  alarm(2, kEnded, 2),
  alarm(3, kShelved),
  alarm(5, kOver),
]);

describe("the list of alarms", () => {
  it("is shown as open, shelved and over, in the monitor's order", () => {
    const groups = groupsOf(kList);
    expect(groups.open.map(({ id }) => id)).toEqual([4, 1, 2]);
    expect(groups.shelved.map(({ id }) => id)).toEqual([3]);
    expect(groups.over.map(({ id }) => id)).toEqual([5]);
    expect(groupsOf(null).open).toEqual([]);
  });

  it("flashes what nobody has acknowledged, also when it has ended", () => {
    expect(kList.alarms.filter(wantsAcknowledgement).map(({ id }) => id)).toEqual([4, 2]);
  });

  it("is counted as the monitor counts, for it may leave some out", () => {
    const list = listOf([alarm(1, kUnacknowledged)], {
      num_warnings: 1000,
      num_unacknowledged_warnings: 998,
    });
    expect(countsOf(list)[0]).toEqual({ severity: 3, on: 1000, unacknowledged: 998 });
    expect(countsText(countsOf(list))).toBe("1000 warnings, 998 unacknowledged; no cautions");
    expect(countsText(countsOf(null))).toBe("no warnings; no cautions");
    expect(countsText(countsOf(kList))).toBe("1 warning, 1 unacknowledged; 1 caution, 1 unacknowledged");
  });

  it("is acknowledged as it was seen", () => {
    expect(acknowledgeAll(kList)).toEqual({
      action: "acknowledge",
      alarm_session_id: 5,
      all_up_to_id: 5,
    });
    expect(acknowledge(kList, alarm(4, kUnacknowledged)).alarm_ids).toEqual([4]);
    expect(shelve(kList, alarm(4, kUnacknowledged), 300)).toMatchObject({
      action: "shelve",
      alarm_ids: [4],
      duration_s: 300,
    });
  });

  it("counts down to nothing, and not below", () => {
    expect(countdown(60)).toBe("1:00");
    expect(countdown(47.2)).toBe("0:48");
    expect(countdown(725)).toBe("12:05");
    expect(countdown(-3)).toBe("0:00");
  });
});
