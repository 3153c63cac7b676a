/** Words for what web-bridge flies ahead, of a formation or a path (cpp/bridge/README.md). */

/** What an envelope limits, by the bridge's names. */
export const kLimitNames: Readonly<Record<string, string>> = {
  min_speed: "least speed",
  max_speed: "greatest speed",
  acceleration: "acceleration",
  course_rate: "turn rate",
  climb: "climb angle",
  climb_rate: "climb-angle rate",
};

/** What such a flight does not know. */
export const kLeftOut =
  "Flown with perfect links; the laws’ integrals begin at nothing, so a steady turn starts up to some metres off.";
