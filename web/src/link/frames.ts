/**
 * Binary frames of the live link: a header of 24 bytes, then one column per quantity, little-endian.
 * Columns are views on the received buffer (every machine that runs a browser is little-endian), nothing is copied.
 */

const kHeaderBytes = 24;
const kVersion = 1;
const kMotionKind = 1;
const kStatusKind = 2;

interface FrameHeader {
  /** Time of the tick on the bus [us]. */
  utime: number;
  /** Since the scenario's start [s], -1: unknown. */
  t_s: number;
  count: number;
}

/** Where the UAVs are, as last heard. */
export interface MotionFrame extends FrameHeader {
  kind: "motion";
  id: Int32Array;
  east_m: Float32Array;
  north_m: Float32Array;
  up_m: Float32Array;
  speed_m_s: Float32Array;
  /** Counter-clockwise from east. */
  course_rad: Float32Array;
  climb_rad: Float32Array;
  /** Since this state was heard. */
  age_s: Float32Array;
  /** Bits kPayloadOn, kHasPayload. */
  flags: Uint8Array;
}

/** What is thought of the UAVs: slots, neighbours, links. */
export interface StatusFrame extends FrameHeader {
  kind: "status";
  id: Int32Array;
  formation_id: Int32Array;
  forward_error_m: Float32Array;
  left_error_m: Float32Array;
  up_error_m: Float32Array;
  nearest_id: Int32Array;
  nearest_horizontal_m: Float32Array;
  nearest_vertical_m: Float32Array;
  tau_id: Int32Array;
  tau_s: Float32Array;
  /** The other UAV that is the reason for the level, 0: none. */
  level_with_id: Int32Array;
  downlink_age_s: Float32Array;
  uplink_age_s: Float32Array;
  estimated_east_m: Float32Array;
  estimated_north_m: Float32Array;
  estimated_up_m: Float32Array;
  horizontal_uncertainty_m: Float32Array;
  vertical_uncertainty_m: Float32Array;
  level: Uint8Array;
  downlink: Uint8Array;
  uplink: Uint8Array;
  /** Bits kHasSlot, kFlown. */
  flags: Uint8Array;
}

export type Frame = MotionFrame | StatusFrame;

export const kPayloadOn = 1;
export const kHasPayload = 2;
export const kHasSlot = 1;
export const kFlown = 2;

/** Reads columns one after the other. */
class Columns {
  private offset = kHeaderBytes;

  constructor(
    private readonly buffer: ArrayBuffer,
    private readonly count: number,
  ) {}

  i32(): Int32Array {
    return new Int32Array(this.buffer, this.take(4), this.count);
  }
  f32(): Float32Array {
    return new Float32Array(this.buffer, this.take(4), this.count);
  }
  u8(): Uint8Array {
    return new Uint8Array(this.buffer, this.take(1), this.count);
  }

  private take(bytes: number): number {
    const at = this.offset;
    this.offset += bytes * this.count;
    return at;
  }
}

const kMotionBytesEach = 8 * 4 + 1;
const kStatusBytesEach = 18 * 4 + 4;

/** The frame in `buffer`; null when it is of a kind or version that this page doesn't know, or has another length than it says. */
export function decodeFrame(buffer: ArrayBuffer): Frame | null {
  if (buffer.byteLength < kHeaderBytes) return null;
  const header = new DataView(buffer);
  if (header.getUint8(1) !== kVersion) return null;
  const count = header.getUint32(4, true);
  const common = { utime: header.getFloat64(8, true), t_s: header.getFloat64(16, true), count };
  const payload_bytes = buffer.byteLength - kHeaderBytes;
  const columns = new Columns(buffer, count);
  switch (header.getUint8(0)) {
    case kMotionKind:
      return payload_bytes === count * kMotionBytesEach ? motionFrame(common, columns) : null;
    case kStatusKind:
      return payload_bytes === count * kStatusBytesEach ? statusFrame(common, columns) : null;
    default:
      return null;
  }
}

// Object literals are evaluated in the order written, which is the order of the columns.
function motionFrame(header: FrameHeader, columns: Columns): MotionFrame {
  return {
    ...header,
    kind: "motion",
    id: columns.i32(),
    east_m: columns.f32(),
    north_m: columns.f32(),
    up_m: columns.f32(),
    speed_m_s: columns.f32(),
    course_rad: columns.f32(),
    climb_rad: columns.f32(),
    age_s: columns.f32(),
    flags: columns.u8(),
  };
}

function statusFrame(header: FrameHeader, columns: Columns): StatusFrame {
  return {
    ...header,
    kind: "status",
    id: columns.i32(),
    formation_id: columns.i32(),
    forward_error_m: columns.f32(),
    left_error_m: columns.f32(),
    up_error_m: columns.f32(),
    nearest_id: columns.i32(),
    nearest_horizontal_m: columns.f32(),
    nearest_vertical_m: columns.f32(),
    tau_id: columns.i32(),
    tau_s: columns.f32(),
    level_with_id: columns.i32(),
    downlink_age_s: columns.f32(),
    uplink_age_s: columns.f32(),
    estimated_east_m: columns.f32(),
    estimated_north_m: columns.f32(),
    estimated_up_m: columns.f32(),
    horizontal_uncertainty_m: columns.f32(),
    vertical_uncertainty_m: columns.f32(),
    level: columns.u8(),
    downlink: columns.u8(),
    uplink: columns.u8(),
    flags: columns.u8(),
  };
}
