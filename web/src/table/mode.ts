import { kModes } from "../panels/mode_text";
import { kLinkLost } from "../state/fleet";
import type { UavRow } from "../state/rows";
import type { Store } from "../state/store";
import { inChosenUnits } from "../units/station_text";

/** What a UAV is doing: what its formation does, unless the station can't reach it. `why` is a sentence. */
export function modeOf(row: UavRow, store: Store): { text: string; why: string } {
  if (row.downlink === kLinkLost || row.uplink === kLinkLost) {
    return { text: "Lost", why: "Its data link is lost: the station doesn't command it." };
  }
  const status = store.statuses.value.get(row.formation_id);
  if (status === undefined) return { text: "Free", why: "It flies in no formation." };
  const name = store.formations.value.get(row.formation_id)?.name ?? "";
  const mode = kModes[status.mode] ?? `Mode ${status.mode}`;
  return {
    text: mode,
    why: `${name === "" ? `Formation ${row.formation_id}` : name}: ${inChosenUnits(status.mode_text) || mode}`,
  };
}
