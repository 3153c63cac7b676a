/** Text messages of the live link (cpp/bridge/README.md). Names and units are those of the LCM fields. */

import type { ControlMessage } from "../control/people";
import type { Replay } from "../state/replay";
import type { PlaybackMessage, RecordingsServed, Reset } from "./recording_messages";

export interface Complete {
  type: "complete";
}

/** A bridge's first word. Everything it knows follows, up to "complete". */
export interface Hello {
  type: "hello";
  version: string;
  lcm_url: string;
  utime: number;
  tile_url: string | null;
  tile_attribution: string;
  /** The map that the bridge serves; null without one. */
  tiles: LocalTiles | null;
  /** Null, or left out by an older bridge: live. */
  replay?: Replay | null;
  /** Null, or left out: none are served. */
  recordings?: RecordingsServed | null;
}

export type LocalTiles =
  | {
      kind: "raster";
      url: string;
      name: string;
      min_zoom: number;
      max_zoom: number;
      attribution: string;
    }
  | { kind: "pmtiles"; url: string; name: string };

export interface Origin {
  latitude_deg: number;
  longitude_deg: number;
  altitude_m: number;
}

export interface Vehicle {
  id: number;
  callsign: string;
  model: string;
  has_payload: boolean;
}

export interface Roster {
  type: "roster";
  utime: number;
  scenario: string;
  start_utime: number;
  origin: Origin;
  vehicles: Vehicle[];
}

export interface Slot {
  vehicle_id: number;
  forward_m: number;
  left_m: number;
  up_m: number;
}

export interface Parameter {
  name: string;
  value: number;
}

/** What CMD_FORMATION applies. */
export interface FormationBody {
  formation_id: number;
  name: string;
  control: string;
  shape: string;
  /** 0 when the shape is custom. */
  spacing_m: number;
  lead_m: number;
  radius_m: number;
  height_m: number;
  d_mod_m: number;
  advisory_tau_s: number;
  caution_tau_s: number;
  hold: boolean;
  /** Gains that differ from the control's preset. */
  parameters: Parameter[];
  slots: Slot[];
}

export interface Formation extends FormationBody {
  type: "formation";
  utime: number;
}

export interface FormationRemoved {
  type: "formation_removed";
  formation_id: number;
}

export interface Waypoint {
  east_m: number;
  north_m: number;
  up_m: number;
  speed_m_s: number;
  /** 0: the smallest that all can fly in comfort. */
  turn_radius_m: number;
}

export interface Path {
  type: "path";
  formation_id: number;
  path_revision: number;
  closed: boolean;
  waypoints: Waypoint[];
  /** [east_m, north_m, up_m] along the path as it will be flown. */
  line: [number, number, number][];
}

export interface SlotStatus {
  vehicle_id: number;
  slot_east_m: number;
  slot_north_m: number;
  slot_up_m: number;
  flown: boolean;
}

export interface FormationStatus {
  type: "status";
  utime: number;
  formation_id: number;
  mode: number;
  mode_utime: number;
  /** 0: not known. */
  mode_end_utime: number;
  mode_text: string;
  leader_east_m: number;
  leader_north_m: number;
  leader_up_m: number;
  leader_speed_m_s: number;
  leader_course_rad: number;
  avoidance_up_m: number;
  slots: SlotStatus[];
}

export interface BusEvent {
  type: "event";
  utime: number;
  event_node: string;
  event_sequence: number;
  severity: number;
  code: string;
  vehicle_id: number;
  formation_id: number;
  text: string;
}

export interface Alarm {
  /** A condition that comes back or becomes worse has a new one. */
  id: number;
  condition: string;
  /** 1 advisory, 2 caution, 3 warning. */
  severity: number;
  /** alarm_t's states: alarms/alarm_list.ts. */
  state: number;
  /** 0: none, as with the other two. */
  vehicle_id: number;
  other_vehicle_id: number;
  formation_id: number;
  text: string;
  raised_utime: number;
  /** 0: not yet, as with the other times. */
  cleared_utime: number;
  acknowledged_utime: number;
  acknowledged_by: string;
  shelved_until_utime: number;
  shelved_by: string;
}

export interface AlarmList {
  type: "alarms";
  utime: number;
  session_id: number;
  newest_id: number;
  num_warnings: number;
  num_cautions: number;
  num_advisories: number;
  num_unacknowledged_warnings: number;
  num_unacknowledged_cautions: number;
  num_unacknowledged_advisories: number;
  num_not_listed: number;
  alarms: Alarm[];
}

export interface RecordingStatus {
  type: "recording";
  utime: number;
  /** 0 stopped by an operator, 1 recording, 2 interrupted: recording_status_t. */
  state: number;
  folder: string;
  /** Its name, which is that of its first file; "": none yet. */
  recording: string;
  part: string;
  /** 0: none yet. */
  started_utime: number;
  parts: number;
  bytes: number;
  /** -1: not known. */
  free_bytes: number;
  /** Why it isn't recording; "" while it is. */
  reason: string;
}

export interface Heartbeat {
  type: "heartbeat";
  utime: number;
  heartbeat_node: string;
  gaps: number;
  undecodable: number;
}

export interface Ack {
  type: "ack";
  id: string | null;
  channel: string;
  accepted: boolean;
  reason: string;
}

export interface BusHealth {
  type: "bus";
  nodes_silent: string[];
}

export type ServerMessage =
  | Hello
  | Roster
  | Formation
  | FormationRemoved
  | Path
  | FormationStatus
  | { type: "statuses"; statuses: FormationStatus[] } // of a large fleet, once a second
  | BusEvent
  | AlarmList
  | RecordingStatus
  | Heartbeat
  | Ack
  | BusHealth
  | PlaybackMessage
  | Reset
  | Complete
  | ControlMessage;

export interface LinkBody {
  vehicle_id: number;
  mode: "up" | "silent" | "frozen";
  uplink?: boolean;
  downlink?: boolean;
  delay_s?: number;
  jitter_s?: number;
  loss?: number;
  duration_s?: number;
}

export type ControlBody =
  | { action: "join"; page: string; take: boolean; name?: string; token?: string }
  | { action: "take" | "ask" | "withdraw" | "release" }
  | { action: "give" | "refuse"; person: number }
  | { action: "rename"; name: string };

export interface AlarmBody {
  action: "acknowledge" | "shelve" | "unshelve";
  /** Of the list that the person sees. */
  alarm_session_id: number;
  alarm_ids?: readonly number[];
  /** All up to this one. */
  all_up_to_id?: number;
  /** To shelve. */
  duration_s?: number;
  operator_name?: string;
}

export type RecordingBody = { operator_name?: string } & (
  { action: "start" | "stop" } | { action: "marker"; text: string }
);

export interface CommandBodies {
  CMD_LINK: LinkBody;
  CMD_SIMULATION: { action: "restart" } | { action: "load"; scenario: string };
  CMD_PAYLOAD: { vehicle_ids: number[]; on: boolean };
  CMD_PATH: { formation_id: number; closed: boolean; waypoints: readonly Waypoint[] };
  CMD_ALARM: AlarmBody;
  CMD_RECORDING: RecordingBody;
  CMD_FORMATION:
    | { action: "apply"; formation: FormationBody }
    | { action: "hold" | "resume" | "remove"; formation: { formation_id: number } };
}

export type CommandChannel = keyof CommandBodies;
