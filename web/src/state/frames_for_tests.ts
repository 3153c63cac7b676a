import type { MotionFrame, StatusFrame } from "../link/frames";

/** Frames for tests: all zero but for what is given. */
export function motionFrame(ids: number[], given: Partial<MotionFrame> = {}): MotionFrame {
  const f32 = () => new Float32Array(ids.length);
  return {
    kind: "motion",
    utime: 1e15,
    t_s: 0,
    count: ids.length,
    id: Int32Array.from(ids),
    east_m: f32(),
    north_m: f32(),
    up_m: f32(),
    speed_m_s: f32(),
    course_rad: f32(),
    climb_rad: f32(),
    age_s: f32(),
    flags: new Uint8Array(ids.length),
    ...given,
  };
}

export function statusFrame(ids: number[], given: Partial<StatusFrame> = {}): StatusFrame {
  const f32 = () => new Float32Array(ids.length);
  const i32 = () => new Int32Array(ids.length);
  const u8 = () => new Uint8Array(ids.length);
  return {
    kind: "status",
    utime: 1e15,
    t_s: 0,
    count: ids.length,
    id: Int32Array.from(ids),
    formation_id: i32(),
    forward_error_m: f32(),
    left_error_m: f32(),
    up_error_m: f32(),
    nearest_id: i32(),
    nearest_horizontal_m: f32(),
    nearest_vertical_m: f32(),
    tau_id: i32(),
    tau_s: f32().fill(-1),
    level_with_id: i32(),
    downlink_age_s: f32(),
    uplink_age_s: f32(),
    estimated_east_m: f32(),
    estimated_north_m: f32(),
    estimated_up_m: f32(),
    horizontal_uncertainty_m: f32(),
    vertical_uncertainty_m: f32(),
    level: u8(),
    downlink: u8(),
    uplink: u8(),
    flags: u8(),
    ...given,
  };
}
