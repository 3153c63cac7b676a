import { useSignal } from "@preact/signals";
import "./payload.css";
import { kPayloadOn } from "../link/frames";
import type { Vehicle } from "../link/messages";
import { CommandButton } from "../panels/command_button";
import type { PanelProps } from "../shell/panel_props";
import type { Station } from "../shell/station";
import { lateSentence } from "./late_sentence";
import { phaseOf } from "./payload_requests";

/** "selected", "all", or the id of a formation. */
type Target = "selected" | "all" | number;

/** Payloads of many at once. What is on and off is counted from telemetry. */
export function PayloadPanel({ station }: PanelProps) {
  const { store, payloads } = station;
  const now_ms = store.now_ms.value;
  const target = useSignal<Target>(store.selection.peek().size > 0 ? "selected" : "all");
  const vehicles = targeted(station, target.value);
  const carriers = vehicles.filter(({ has_payload }) => has_payload).map(({ id }) => id);
  const counts = count(station, carriers, now_ms);
  const formations = [...store.formations.value.values()].sort((a, b) => a.formation_id - b.formation_id);
  const choices: [Target, string][] = [
    ["selected", `Selected (${store.selection.value.size})`],
    ["all", "All"],
    ...formations.map(({ formation_id, name }): [Target, string] => [
      formation_id,
      name === "" ? `Formation ${formation_id}` : name,
    ]),
  ];
  const problem = lateSentence(store, payloads, now_ms);
  return (
    <div class="payload-panel">
      <fieldset>
        <legend>Whose payload</legend>
        {choices.map(([value, label]) => (
          <label key={value} class="payload-target">
            <input
              type="radio"
              name="payload-target"
              checked={target.value === value}
              onChange={() => (target.value = value)}
            />
            {label}
          </label>
        ))}
      </fieldset>
      <p>
        {vehicles.length === 0
          ? target.value === "selected"
            ? "Nobody is selected. Select UAVs on the map or in the table."
            : typeof target.value === "number"
              ? "That formation is flown no more."
              : "No UAV is known yet."
          : `${carriers.length} of ${vehicles.length} ${vehicles.length === 1 ? "carries" : "carry"} a payload.`}
      </p>
      <div class="payload-buttons">
        <CommandButton
          class="button wide"
          label="Switch on the payloads"
          disabled={carriers.length === 0}
          command={() => payloads.request(carriers, true)}
        >
          Switch on
        </CommandButton>
        <CommandButton
          class="button wide"
          label="Switch off the payloads"
          disabled={carriers.length === 0}
          command={() => payloads.request(carriers, false)}
        >
          Switch off
        </CommandButton>
      </div>
      <dl class="payload-counts" aria-label="As telemetry says">
        <div>
          <dt>On</dt>
          <dd>{counts.on}</dd>
        </div>
        <div>
          <dt>Off</dt>
          <dd>{counts.off}</dd>
        </div>
        <div class={counts.pending > 0 ? "pending" : ""}>
          <dt>Waiting for telemetry</dt>
          <dd>{counts.pending}</dd>
        </div>
        <div>
          <dt>Not followed</dt>
          <dd>{counts.late}</dd>
        </div>
      </dl>
      <p class="payload-message" role="status">
        {problem}
      </p>
      <p class="hint">
        On and off are what telemetry says. A UAV whose link is lost shows what it said last.
      </p>
    </div>
  );
}

function targeted(station: Station, target: Target): Vehicle[] {
  const { store } = station;
  const vehicles = store.roster.value?.vehicles ?? [];
  if (target === "all") return vehicles;
  if (target === "selected") return vehicles.filter(({ id }) => store.selection.value.has(id));
  const members = new Set(store.formations.value.get(target)?.slots.map(({ vehicle_id }) => vehicle_id));
  return vehicles.filter(({ id }) => members.has(id));
}

/** On and off by telemetry alone; those that were asked and haven't followed are counted beside it. */
function count({ store, payloads }: Station, ids: readonly number[], now_ms: number) {
  const counts = { on: 0, off: 0, pending: 0, late: 0 };
  for (const id of ids) {
    const row = store.fleet.motionRow(id);
    const { motion } = store.fleet;
    if (row < 0 || motion === null) continue;
    const on = (motion.flags[row] & kPayloadOn) !== 0;
    counts[on ? "on" : "off"] += 1;
    const phase = phaseOf(payloads.askedOf(id), on, now_ms);
    if (phase !== "settled") counts[phase] += 1;
  }
  return counts;
}
