import type { Commands } from "../link/commands";
import { identityOf } from "../map/colours";
import type { UavRow } from "../state/rows";
import type { Store } from "../state/store";
import { compass, fixed, kNone } from "../units/format";
import { CommandButton } from "./command_button";
import { Chain, kLinkNames, Lamp } from "./icons";

interface UavRowProps {
  row: UavRow;
  store: Store;
  commands: Commands;
}

export function UavRowView({ row, store, commands }: UavRowProps) {
  const selected = store.selection.value.has(row.id);
  const select = () => {
    store.select(selected ? [] : [row.id]);
  };
  const { error, nearest, tau, motion } = row;
  return (
    <tr
      data-id={row.id}
      data-level={row.level}
      class={`${row.stale ? "stale-row" : ""} ${selected ? "selected" : ""}`}
    >
      <td class="centre">
        <Lamp level={row.level} />
      </td>
      <th scope="row" class="left">
        <button
          type="button"
          class="uav-name"
          aria-pressed={selected}
          title={`Select ${row.callsign}`}
          onClick={select}
        >
          <Chip id={row.id} />
          <span>{row.callsign}</span>
        </button>
      </th>
      <LinkCell direction="Downlink" state={row.downlink} age_s={row.downlink_age_s} />
      <LinkCell direction="Uplink" state={row.uplink} age_s={row.uplink_age_s} />
      <td class="value error">{error === null ? kNone : fixed(error.forward_m, 1)}</td>
      <td class="value error">{error === null ? kNone : fixed(error.left_m, 1)}</td>
      <td class="value error">{error === null ? kNone : fixed(error.up_m, 1)}</td>
      <td class="centre">
        {nearest === null ? kNone : <Chip id={nearest.id} title={store.callsign(nearest.id)} />}
      </td>
      <td class="value">{nearest === null ? kNone : fixed(nearest.horizontal_m)}</td>
      <td class="value">{nearest === null ? kNone : fixed(nearest.vertical_m)}</td>
      <td class="centre">{tau === null ? kNone : <Chip id={tau.id} title={store.callsign(tau.id)} />}</td>
      <td class="value">{tau === null ? kNone : fixed(tau.seconds)}</td>
      <td class="value altitude">{motion === null ? kNone : fixed(motion.up_m)}</td>
      <td class="value speed">{motion === null ? kNone : fixed(motion.speed_m_s, 1)}</td>
      <td class="value">{motion === null ? kNone : compass(motion.course_rad)}</td>
      <td class="centre">
        {row.has_payload ? (
          <PayloadSwitch row={row} commands={commands} />
        ) : (
          <span title="It carries none">{kNone}</span>
        )}
      </td>
      <td class="centre link-control">
        <LinkButtons row={row} commands={commands} />
      </td>
    </tr>
  );
}

/** A UAV's number in its identity colour, as on the map. */
function Chip({ id, title }: { id: number; title?: string }) {
  return (
    <span class={`chip identity-${identityOf(id)}`} title={title}>
      {id}
    </span>
  );
}

/** Below this the link is as good as it can be, and its age is no news [s]. */
const kShownAge_s = 1;

function LinkCell({ direction, state, age_s }: { direction: string; state: number; age_s: number }) {
  const age = age_s >= kShownAge_s ? `${fixed(Math.min(age_s, 9999))} s` : "";
  return (
    <td class="left link-cell">
      <Chain state={state} label={`${direction} ${kLinkNames[state] ?? "unknown"}`} />
      <span class="link-age">{age}</span>
    </td>
  );
}

function PayloadSwitch({ row, commands }: { row: UavRow; commands: Commands }) {
  const on = row.motion?.payload_on ?? false;
  return (
    <CommandButton
      class="switch"
      checked={on}
      label={`Payload of ${row.callsign}`}
      command={() => commands.request("CMD_PAYLOAD", { vehicle_ids: [row.id], on: !on })}
    >
      <span class="switch-knob" />
    </CommandButton>
  );
}

/** Both are always there: what telemetry says lags behind what was commanded by seconds. */
function LinkButtons({ row, commands }: { row: UavRow; commands: Commands }) {
  const set = (mode: "up" | "silent") => () => commands.request("CMD_LINK", { vehicle_id: row.id, mode });
  return (
    <span class="button-pair">
      <CommandButton label={`Cut the link of ${row.callsign}`} command={set("silent")}>
        Cut
      </CommandButton>
      <CommandButton label={`Restore the link of ${row.callsign}`} command={set("up")}>
        Restore
      </CommandButton>
    </span>
  );
}
