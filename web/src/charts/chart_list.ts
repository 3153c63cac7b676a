/** The charts: the paper's data display. */
import { altitude, distance, kAltitudeReference, speed } from "../units/quantities";
import type { ColumnName } from "./flight_series";

export interface ChartSpec {
  column: ColumnName;
  title: string;
  /** As shown; changes with the person's choice. */
  unit: () => string;
  /** From SI into what is shown. */
  value: (si: number) => number;
  decimals: number;
  /** For the head of a file's column, always SI (and compass degrees). */
  file_name: string;
  file_value: (si: number) => number;
  /** Of a quantity that goes round. */
  period?: number;
}

const same = (si: number) => si;
const kRound_deg = 360;

/** Compass degrees, 0 .. 360. */
export function compassDegrees(course_rad: number): number {
  const degrees = (90 - (course_rad * 180) / Math.PI) % kRound_deg;
  return degrees < 0 ? degrees + kRound_deg : degrees;
}

const onItself = (column: ColumnName) => ({ column, file_name: column, file_value: same });

export const kCharts: readonly ChartSpec[] = [
  {
    ...onItself("up_m"),
    title: "Altitude",
    unit: () => `${altitude.unit()} ${kAltitudeReference}`,
    value: altitude.value,
    decimals: 0,
  },
  { ...onItself("speed_m_s"), title: "Speed", unit: speed.unit, value: speed.value, decimals: 1 },
  {
    column: "course_rad",
    title: "Course",
    unit: () => "°",
    value: compassDegrees,
    decimals: 0,
    file_name: "course_deg",
    // A hair left of north is 0, not 360.
    file_value: (rad) => Number(compassDegrees(rad).toFixed(3)) % kRound_deg,
    period: kRound_deg,
  },
  {
    ...onItself("forward_error_m"),
    title: "Slot error forward",
    unit: distance.unit,
    value: distance.value,
    decimals: 1,
  },
  {
    ...onItself("left_error_m"),
    title: "Slot error left",
    unit: distance.unit,
    value: distance.value,
    decimals: 1,
  },
  {
    ...onItself("up_error_m"),
    title: "Slot error up",
    unit: altitude.unit,
    value: altitude.value,
    decimals: 1,
  },
  {
    ...onItself("nearest_horizontal_m"),
    title: "Nearest, horizontal R",
    unit: distance.unit,
    value: distance.value,
    decimals: 0,
  },
  {
    ...onItself("nearest_vertical_m"),
    title: "Nearest, vertical H",
    unit: altitude.unit,
    value: altitude.value,
    decimals: 0,
  },
  { ...onItself("tau_s"), title: "Least Tau", unit: () => "s", value: same, decimals: 0 },
];
