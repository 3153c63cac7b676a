import { CommandButton } from "../panels/command_button";
import type { UavRow } from "../state/rows";
import type { CellContext } from "./cell_context";

/** Both are always there: what telemetry says lags behind what was commanded by seconds. */
export function LinkButtons({ row, station, tab_index }: CellContext & { row: UavRow }) {
  const set = (mode: "up" | "silent") => () =>
    station.commands.request("CMD_LINK", { vehicle_id: row.id, mode });
  return (
    <span class="button-pair">
      <CommandButton label={`Cut the link of ${row.callsign}`} tabIndex={tab_index} command={set("silent")}>
        Cut
      </CommandButton>
      <CommandButton label={`Restore the link of ${row.callsign}`} tabIndex={tab_index} command={set("up")}>
        Restore
      </CommandButton>
    </span>
  );
}
