import { CommandButton } from "../panels/command_button";
import { phaseOf } from "../payload/payload_requests";
import type { UavRow } from "../state/rows";
import { kNone } from "../units/format";
import type { CellContext } from "./cell_context";

/** A switch that shows what telemetry says; while it is waited for, the knob stands in the middle. */
export function PayloadCell({ row, station, tab_index }: CellContext & { row: UavRow }) {
  if (!row.has_payload) return <span title="It carries none">{kNone}</span>;
  const on = row.motion?.payload_on ?? false;
  const asked = station.payloads.askedOf(row.id);
  const phase = phaseOf(asked, on, station.store.now_ms.value);
  const wanted = asked?.on === true ? "on" : "off";
  return (
    <span
      class="payload-cell"
      data-phase={phase}
      title={
        phase === "pending"
          ? `Switched ${wanted}: waiting for telemetry`
          : phase === "late"
            ? `Switched ${wanted}, but telemetry doesn't show it`
            : undefined
      }
    >
      <CommandButton
        class={`switch ${phase}`}
        checked={on}
        label={`Payload of ${row.callsign}`}
        tabIndex={tab_index}
        command={() => station.payloads.request([row.id], !on)}
      >
        <span class="switch-knob" />
      </CommandButton>
      {phase === "late" && <span class="payload-late">?</span>}
    </span>
  );
}
