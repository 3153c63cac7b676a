import { expect, test } from "vitest";
import { kFlown, kHasSlot, kPayloadOn } from "../link/frames";
import { Fleet, kLinkLost } from "./fleet";
import { motionFrame, statusFrame } from "./frames_for_tests";
import { uavRow } from "./rows";

const f32 = (...values: number[]) => Float32Array.from(values);
const kVehicle = { id: 7, callsign: "UAV7", model: "default", has_payload: true };

test("between frames a UAV is carried along its velocity, for two seconds at most", () => {
  const fleet = new Fleet();
  const climb_rad = Math.asin(0.1);
  fleet.take(
    motionFrame([7], {
      east_m: f32(100),
      north_m: f32(200),
      up_m: f32(1000),
      speed_m_s: f32(50),
      course_rad: f32(Math.PI / 2),
      climb_rad: f32(climb_rad),
      age_s: f32(0.5),
    }),
    10_000,
  );
  const soon = fleet.placeAt(0, 10_500); // 1 s after it was heard
  expect(soon.east_m).toBeCloseTo(100, 3);
  expect(soon.north_m).toBeCloseTo(200 + 50 * Math.cos(climb_rad), 3);
  expect(soon.up_m).toBeCloseTo(1005, 3);
  expect(fleet.placeAt(0, 99_000).up_m).toBeCloseTo(1010, 3);
  expect(fleet.placeAt(0, 9_000).up_m).toBeCloseTo(1002.5, 3); // the screen's clock is behind the frame's
});

test("frames whose time stands still are no news", () => {
  const fleet = new Fleet();
  fleet.take(motionFrame([7], { utime: 5e6 }), 1000);
  fleet.take(motionFrame([7], { utime: 5e6 }), 2000);
  expect(fleet.sinceMotion_ms(2500)).toBe(1500);
  fleet.take(motionFrame([7], { utime: 6e6 }), 3000);
  expect(fleet.sinceMotion_ms(3500)).toBe(500);
});

test("a recording carries its UAVs on as fast as it is played, back when it goes backwards", () => {
  const fleet = new Fleet();
  const east_m = (now_ms: number) => fleet.placeAt(0, now_ms).east_m;
  fleet.pace.set(4, 0);
  fleet.take(motionFrame([7], { speed_m_s: f32(50) }), 1000);
  fleet.take(statusFrame([7], { downlink_age_s: f32(1) }), 1000);
  expect(east_m(1100)).toBeCloseTo(20, 3);
  expect(fleet.downlinkAge_s(7, 1100)).toBeCloseTo(1.4, 6);
  fleet.pace.set(0, 1100); // paused: it stays where it is
  expect(east_m(90_000)).toBeCloseTo(20, 3);
  expect(fleet.sinceMotion_ms(90_000)).toBeCloseTo(400, 6);
  fleet.pace.set(-1, 90_000);
  fleet.take(motionFrame([7], { utime: 1e15 - 1, speed_m_s: f32(50) }), 90_000);
  expect(east_m(90_500)).toBeCloseTo(-25, 3);
});

test("a lost UAV is where the monitor thinks it is, and flies on level between two of its reports", () => {
  const fleet = new Fleet();
  const climb_rad = Math.asin(0.6);
  fleet.take(motionFrame([6, 7], { speed_m_s: f32(50, 50), climb_rad: f32(0, climb_rad) }), 0);
  fleet.take(
    statusFrame([7, 6], { downlink: Uint8Array.of(kLinkLost, 0), estimated_east_m: f32(900, 0) }),
    0,
  );
  expect(fleet.isLost(7)).toBe(true);
  expect(fleet.isLost(6)).toBe(false);
  expect(fleet.placeAt(1, 0).east_m).toBe(900);
  expect(fleet.placeAt(1, 1000).east_m).toBeCloseTo(940, 3);
  expect(fleet.placeAt(1, 1000).up_m).toBe(0);
  expect(fleet.placeAt(0, 1000).east_m).toBeCloseTo(50, 3);
});

test("rows follow a fleet that changes", () => {
  const fleet = new Fleet();
  fleet.take(motionFrame([1, 2]), 0);
  fleet.take(motionFrame([2, 3]), 0);
  expect([1, 2, 3].map((id) => fleet.motionRow(id))).toEqual([-1, 0, 1]);
  fleet.clear();
  expect(fleet.motionRow(2)).toBe(-1);
});

test("a UAV that was never heard has a row of blanks", () => {
  expect(uavRow(new Fleet(), kVehicle, 0)).toMatchObject({
    level: -1,
    downlink: 3,
    error: null,
    nearest: null,
    tau: null,
    motion: null,
    stale: true,
  });
});

test("a row says what the columns say", () => {
  const fleet = new Fleet();
  fleet.take(motionFrame([7], { up_m: f32(1000), flags: Uint8Array.of(kPayloadOn) }), 0);
  fleet.take(
    statusFrame([7], {
      level: Uint8Array.of(2),
      flags: Uint8Array.of(kHasSlot | kFlown),
      left_error_m: f32(-4),
      nearest_id: Int32Array.of(3),
      nearest_horizontal_m: f32(480),
      tau_id: Int32Array.of(5),
      tau_s: f32(0),
      downlink_age_s: f32(1.5),
      uplink_age_s: f32(-1),
    }),
    1000,
  );
  const row = uavRow(fleet, kVehicle, 2000);
  expect(row).toMatchObject({
    level: 2,
    error: { left_m: -4 },
    nearest: { id: 3, horizontal_m: 480 },
    tau: { id: 5, seconds: 0 }, // zero seconds is the worst there is, not none
    motion: { up_m: 1000, payload_on: true },
    flown: true,
    stale: false,
  });
  expect(row.downlink_age_s).toBeCloseTo(2.5, 6);
  expect(row.uplink_age_s).toBe(-1);
});
