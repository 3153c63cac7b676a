/** Gains of the control laws with their presets and ranges (cpp/core/README.md), held equal to them by tests/golden/gains.csv. */

export const kControls = ["skein", "paper"] as const;
export type Control = (typeof kControls)[number];

export const kControlNames: Readonly<Record<Control, string>> = {
  skein: "Skein: slots follow the path",
  paper: "Paper: rigid slots, PID",
};

export interface Gain {
  name: string;
  /** What it does, for people. */
  label: string;
  unit: string;
  preset: number;
  least: number;
  /** None: Infinity. */
  most: number;
}

/** Stands for "more than nothing". */
const kAboveNone = 1e-6;

const gain = (
  name: string,
  label: string,
  unit: string,
  preset: number,
  least: number,
  most = Infinity,
): Gain => ({ name, label, unit, preset, least, most });

const kSkein: readonly Gain[] = [
  gain("position_per_s", "Approach speed per metre of slot error", "1/s", 0.2, kAboveNone, 2),
  gain("speed_per_s", "Speed loop", "1/s", 0.7, kAboveNone, 5),
  gain("course_per_s", "Course loop", "1/s", 0.7, kAboveNone, 5),
  gain("climb_per_s", "Climb loop", "1/s", 0.7, kAboveNone, 5),
  gain("integral_per_s2", "Integral", "1/s²", 0.004, 0, 1),
  gain("integral_zone_m", "Integral works within", "m", 20, 0, 1e4),
  gain("approach_share", "Share of the acceleration limit for approaches", "", 0.6, kAboveNone, 1),
  gain("lateral_m_s2", "Braking of sideways approaches", "m/s²", 2.5, kAboveNone, 20),
  gain("lateral_m_s", "Fastest sideways approach", "m/s", 30, kAboveNone, 200),
  gain("vertical_m_s2", "Braking of vertical approaches", "m/s²", 1.5, kAboveNone, 20),
  gain("vertical_m_s", "Fastest vertical approach", "m/s", 10, kAboveNone, 100),
  gain("margin_m_s", "Speed kept free at both ends of the envelope", "m/s", 2, 0, 100),
];

const pid = (axis: string, p: number, i: number): readonly Gain[] => [
  gain(`${axis}_p`, `P of the ${axis} loop`, "", p, 0),
  gain(`${axis}_i`, `I of the ${axis} loop`, "1/s", i, 0),
  gain(`${axis}_d`, `D of the ${axis} loop`, "s", 1, 0),
  gain(`${axis}_n`, `Filter of D in the ${axis} loop`, "1/s", 1, kAboveNone),
];

const kPaper: readonly Gain[] = [
  gain("k_ex", "Forward error", "1/m", 1.5, 0),
  gain("k_ev", "Speed error", "s/m", 10, 0),
  gain("k_ey", "Left error", "1/m", 0.1, 0),
  gain("k_ephi", "Course error", "1/rad", 10, 0),
  gain("k_ez", "Up error", "1/m", 0.04, 0),
  gain("k_emu", "Climb error", "1/rad", 5, 0),
  gain("saturation_forward_m", "Saturation forward", "m", 50, kAboveNone),
  gain("saturation_left_m", "Saturation left", "m", 50, kAboveNone),
  gain("saturation_up_m", "Saturation up", "m", 50, kAboveNone),
  ...pid("speed", 3, 0.1),
  ...pid("course", 5, 1),
  ...pid("climb", 5, 0.1),
];

export const kGains: Readonly<Record<Control, readonly Gain[]>> = { skein: kSkein, paper: kPaper };

export function isControl(name: string): name is Control {
  return (kControls as readonly string[]).includes(name);
}
