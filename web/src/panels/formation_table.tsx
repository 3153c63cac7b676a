import type { PanelProps } from "../shell/panel_list";
import { kLinkLost } from "../state/fleet";
import { uavRow, type UavRow } from "../state/rows";
import { Chain, Lamp, kLevelNames } from "./icons";
import { UavRowView } from "./uav_row";

/** The paper's Formation Information: a row a UAV. */
export function FormationTable({ station }: PanelProps) {
  const { store, commands } = station;
  const now_ms = store.now_ms.value;
  const vehicles = [...(store.roster.value?.vehicles ?? [])].sort((a, b) => a.id - b.id);
  const rows = vehicles.map((vehicle) => uavRow(store.fleet, vehicle, now_ms));
  return (
    <section class="table-panel" aria-label="Formation information">
      <div class="table-head">
        <Summary rows={rows} />
      </div>
      <div class="table-scroll">
        <table class="uav-table">
          <thead>
            <tr class="groups">
              <th scope="col" rowSpan={2}>
                <span class="visually-hidden">Warning level</span>
              </th>
              <th scope="col" rowSpan={2} class="left">
                UAV
              </th>
              <th scope="colgroup" colSpan={2}>
                Data link
              </th>
              <th scope="colgroup" colSpan={3}>
                Error from slot, m
              </th>
              <th scope="colgroup" colSpan={3}>
                Nearest UAV
              </th>
              <th scope="colgroup" colSpan={2}>
                Tau
              </th>
              <th scope="col" title="Above the origin of the local ENU frame">
                Altitude
              </th>
              <th scope="col">Speed</th>
              <th scope="col">Course</th>
              <th scope="col" rowSpan={2} class="centre">
                Payload
              </th>
              <th scope="col" rowSpan={2} class="centre">
                Link control
              </th>
            </tr>
            <tr>
              <th scope="col" class="left" title="UAV to station, and how long since it was heard">
                Down
              </th>
              <th scope="col" class="left" title="Station to UAV, and how long since it obeyed">
                Up
              </th>
              <th scope="col">Forward</th>
              <th scope="col">Left</th>
              <th scope="col">Up</th>
              <th scope="col" class="centre">
                UAV
              </th>
              <th scope="col" title="Horizontal distance">
                R, m
              </th>
              <th scope="col" title="Vertical distance">
                H, m
              </th>
              <th scope="col" class="centre">
                UAV
              </th>
              <th scope="col" title="Time to closest approach of the pair that meets first">
                s
              </th>
              <th scope="col" title="Above the origin of the local ENU frame">
                m ENU
              </th>
              <th scope="col">m/s</th>
              <th scope="col" title="Compass degrees">
                °
              </th>
            </tr>
          </thead>
          <tbody>
            {rows.map((row) => (
              <UavRowView key={row.id} row={row} store={store} commands={commands} />
            ))}
          </tbody>
        </table>
        {rows.length === 0 && <p class="empty">No UAV is known yet.</p>}
      </div>
    </section>
  );
}

/** How the whole fleet is, in a line. */
function Summary({ rows }: { rows: readonly UavRow[] }) {
  const lost = rows.filter((row) => row.downlink === kLinkLost || row.uplink === kLinkLost).length;
  return (
    <ul class="summary" aria-label="Summary">
      <li>{rows.length === 1 ? "1 UAV" : `${rows.length} UAVs`}</li>
      {[3, 2, 1].map((level) => {
        const count = rows.filter((row) => row.level === level).length;
        return (
          count > 0 && (
            <li key={level}>
              <Lamp level={level} />
              {count} {kLevelNames[level]?.toLowerCase()}
            </li>
          )
        );
      })}
      {lost > 0 && (
        <li class="lost">
          <Chain state={kLinkLost} label="Link lost" />
          {lost === 1 ? "1 link lost" : `${lost} links lost`}
        </li>
      )}
    </ul>
  );
}
