import { beforeEach, describe, expect, it } from "vitest";
import type { AlarmList } from "../link/messages";
import { kAcknowledged, kEnded, kShelved, kUnacknowledged } from "./alarm_list";
import { alarm, listOf } from "./list_for_tests";
import { kRepeat_ms, SoundSchedule } from "./sound_schedule";

const all = () => true;
const kWarning_ms = kRepeat_ms[3] ?? 0;
const kCaution_ms = kRepeat_ms[2] ?? 0;

describe("the sound of alarms", () => {
  let schedule: SoundSchedule;
  let now_ms: number;
  const heard = (list: AlarmList | null, wanted: (severity: number) => boolean = all) =>
    schedule.next(list, now_ms, wanted);

  beforeEach(() => {
    schedule = new SoundSchedule();
    now_ms = 1000;
  });

  it("is silent without alarms, or without a list", () => {
    expect(heard(null)).toBe(0);
    expect(heard(listOf([]))).toBe(0);
  });

  it("comes at once, and once for an occurrence however often it is told", () => {
    const list = listOf([alarm(1, kUnacknowledged)]);
    expect(heard(list)).toBe(3);
    for (let i = 0; i < 10; ++i) {
      now_ms += kWarning_ms / 20;
      expect(heard({ ...list, utime: now_ms })).toBe(0);
    }
  });

  it("is repeated until it is acknowledged", () => {
    expect(heard(listOf([alarm(1, kUnacknowledged)]))).toBe(3);
    now_ms += kWarning_ms;
    expect(heard(listOf([alarm(1, kUnacknowledged)]))).toBe(3);
    now_ms += kWarning_ms;
    expect(heard(listOf([alarm(1, kAcknowledged)]))).toBe(0);
  });

  it("ends with the condition, and on the shelf", () => {
    expect(heard(listOf([alarm(1, kUnacknowledged)]))).toBe(3);
    now_ms += kWarning_ms;
    expect(heard(listOf([alarm(1, kEnded)]))).toBe(0);
    expect(heard(listOf([alarm(1, kShelved)]))).toBe(0);
  });

  it("is that of the worst", () => {
    expect(heard(listOf([alarm(1, kUnacknowledged, 2), alarm(2, kUnacknowledged, 3)]))).toBe(3);
    now_ms += kWarning_ms;
    expect(heard(listOf([alarm(1, kUnacknowledged, 2), alarm(2, kAcknowledged, 3)]))).toBe(0);
    now_ms += kCaution_ms;
    expect(heard(listOf([alarm(1, kUnacknowledged, 2), alarm(2, kAcknowledged, 3)]))).toBe(2);
  });

  it("comes at once for a new one, also in the midst of another's repetitions", () => {
    expect(heard(listOf([alarm(1, kUnacknowledged, 3)]))).toBe(3);
    now_ms += 250;
    expect(heard(listOf([alarm(1, kUnacknowledged, 3), alarm(2, kUnacknowledged, 2)]))).toBe(2);
  });

  it("begins anew with a monitor that was started anew", () => {
    expect(heard(listOf([alarm(7, kUnacknowledged)]))).toBe(3);
    now_ms += 250;
    expect(heard(listOf([alarm(1, kUnacknowledged)], { session_id: 6 }))).toBe(3);
  });

  it("leaves out severities that are not wanted", () => {
    const only_warnings = (severity: number) => severity === 3;
    expect(heard(listOf([alarm(1, kUnacknowledged, 2)]), only_warnings)).toBe(0);
    expect(heard(listOf([alarm(1, kUnacknowledged, 2), alarm(2, kUnacknowledged, 3)]), only_warnings)).toBe(
      3,
    );
  });

  it("of an advisory is heard once", () => {
    expect(heard(listOf([alarm(1, kUnacknowledged, 1)]))).toBe(1);
    now_ms += 1e6;
    expect(heard(listOf([alarm(1, kUnacknowledged, 1)]))).toBe(0);
  });
});
