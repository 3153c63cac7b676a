import type { Station } from "./station";

/** What every panel takes. */
export interface PanelProps {
  station: Station;
}
