/** All panels of the page, one entry each. A new panel is a new line here. */
import type { ComponentType } from "preact";
import { AlarmPanel } from "../alarms/alarm_panel";
import { EventList } from "../events/event_list";
import { FormationPanel } from "../formation/formation_panel";
import { ChartsPanel } from "../charts/charts_panel";
import { PlanPanel } from "../plan/plan_panel";
import { PayloadPanel } from "../payload/payload_panel";
import { FormationTable } from "../table/formation_table";
import { SimulationPanel } from "../simulation/simulation_panel";
import { RecordingsPanel } from "../recordings/recordings_panel";
import type { IconName } from "./icon";
import type { PanelProps } from "./panel_props";

export interface PanelSpec {
  id: string;
  title: string;
  view: ComponentType<PanelProps>;
}

export interface DrawerSpec extends PanelSpec {
  icon: IconName;
  /** Opens and closes it. */
  shortcut: string;
}

export interface DockSpec extends PanelSpec {
  /** Opens it and takes the focus there. */
  shortcut: string;
  /** What the keys do in it, for the help. */
  keys: string;
}

/** Tools, one open at a time, in the drawer on the left. */
export const kDrawerPanels: readonly DrawerSpec[] = [
  { id: "formation", title: "Formation", icon: "formation", shortcut: "e", view: FormationPanel },
  { id: "plan", title: "Plan", icon: "plan", shortcut: "p", view: PlanPanel },
  { id: "payload", title: "Payload", view: PayloadPanel, icon: "payload", shortcut: "y" },
  { id: "simulation", title: "Simulation", icon: "simulation", shortcut: "s", view: SimulationPanel },
  { id: "recordings", title: "Recordings", icon: "recordings", shortcut: "r", view: RecordingsPanel },
];

/** Beside the map on the right. */
export const kSidePanels: readonly PanelSpec[] = [
  { id: "alarms", title: "Alarms", view: AlarmPanel },
  { id: "events", title: "Events", view: EventList },
];

/** Below the map. */
export const kDockPanels: readonly DockSpec[] = [
  {
    id: "table",
    title: "Table",
    view: FormationTable,
    shortcut: "t",
    keys: "arrows move, Space selects, Enter centres the map, Ctrl+A takes all, Esc none",
  },
  {
    id: "charts",
    title: "Charts",
    view: ChartsPanel,
    shortcut: "c",
    keys: "+ and \u2212 zoom, arrows move, with Shift the cursor, 0 shows all",
  },
];
