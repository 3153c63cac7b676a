import type { PanelProps } from "../shell/panel_props";
import { LinkControls } from "./link_controls";
import { ScenarioControls } from "./scenario_controls";
import "./simulation.css";

const kSimulator = "fleet-simulator";

/** What can be done to a fleet that is simulated: its data links, its scenario. */
export function SimulationPanel({ station }: PanelProps) {
  const { store } = station;
  const present = store.heartbeats.value.has(kSimulator) && !store.silent_nodes.value.includes(kSimulator);
  if (!present) {
    return (
      <div class="simulation">
        <p>
          <strong>No simulator is on the bus.</strong>
        </p>
        <p class="hint">
          Links can be cut and scenarios restarted where fleet-simulator flies the UAVs. It{" "}
          {store.heartbeats.value.has(kSimulator) ? "has fallen silent." : "has not been heard."} Start it
          with
        </p>
        <code>build/bin/fleet-simulator --scenario triangle</code>
      </div>
    );
  }
  return (
    <div class="simulation">
      <ScenarioControls station={station} />
      <LinkControls station={station} />
    </div>
  );
}
