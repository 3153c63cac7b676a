/** One UAV as the table shows it: a plain record read out of the fleet's columns. */
import { kFlown, kHasSlot, kPayloadOn } from "../link/frames";
import type { Vehicle } from "../link/messages";
import { kLinkUp, type Fleet } from "./fleet";

export interface Neighbour {
  id: number;
  horizontal_m: number;
  vertical_m: number;
}

export interface UavRow {
  id: number;
  callsign: string;
  has_payload: boolean;
  /** 0: none. */
  formation_id: number;
  /** 0..3, -1: not judged yet. */
  level: number;
  /** link_status_t's numbers, 3: not judged. */
  downlink: number;
  uplink: number;
  downlink_age_s: number;
  uplink_age_s: number;
  /** Slot minus UAV; null: it has no slot. */
  error: { forward_m: number; left_m: number; up_m: number } | null;
  /** False while the station doesn't command it: its errors are then dead-reckoned. */
  flown: boolean;
  nearest: Neighbour | null;
  tau: { id: number; seconds: number } | null;
  /** Null: never heard. */
  motion: { up_m: number; speed_m_s: number; course_rad: number; payload_on: boolean } | null;
  /** What is shown of it is old. */
  stale: boolean;
}

const kUnknown = 3;

export function uavRow(fleet: Fleet, vehicle: Vehicle, now_ms: number): UavRow {
  const m = fleet.motionRow(vehicle.id);
  const s = fleet.statusRow(vehicle.id);
  const motion = m < 0 ? null : fleet.motion;
  const status = s < 0 ? null : fleet.status;
  const has_slot = status !== null && (status.flags[s] & kHasSlot) !== 0;
  const downlink = status === null ? kUnknown : status.downlink[s];
  return {
    id: vehicle.id,
    callsign: vehicle.callsign,
    has_payload: vehicle.has_payload,
    formation_id: status === null ? 0 : status.formation_id[s],
    level: status === null ? -1 : status.level[s],
    downlink,
    uplink: status === null ? kUnknown : status.uplink[s],
    downlink_age_s: fleet.downlinkAge_s(vehicle.id, now_ms),
    uplink_age_s: fleet.uplinkAge_s(vehicle.id, now_ms),
    error:
      status === null || !has_slot
        ? null
        : {
            forward_m: status.forward_error_m[s],
            left_m: status.left_error_m[s],
            up_m: status.up_error_m[s],
          },
    flown: status !== null && (status.flags[s] & kFlown) !== 0,
    nearest:
      status === null || status.nearest_id[s] === 0
        ? null
        : {
            id: status.nearest_id[s],
            horizontal_m: status.nearest_horizontal_m[s],
            vertical_m: status.nearest_vertical_m[s],
          },
    tau: status === null || status.tau_s[s] < 0 ? null : { id: status.tau_id[s], seconds: status.tau_s[s] },
    motion:
      motion === null
        ? null
        : {
            up_m: motion.up_m[m],
            speed_m_s: motion.speed_m_s[m],
            course_rad: motion.course_rad[m],
            payload_on: (motion.flags[m] & kPayloadOn) !== 0,
          },
    stale: downlink !== kLinkUp,
  };
}
