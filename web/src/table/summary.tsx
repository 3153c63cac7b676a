import { Chain, kLevelNames, Lamp } from "../panels/icons";
import { kLinkLost } from "../state/fleet";
import type { Store } from "../state/store";

/** How the whole fleet is, in a line. */
export function Summary({ store }: { store: Store }) {
  // Telemetry is no signal: it is read on the beat.
  void store.now_ms.value;
  const { vehicles = [] } = store.roster.value ?? {};
  const status = store.fleet.status;
  const levels = [0, 0, 0, 0];
  let lost = 0;
  for (const { id } of vehicles) {
    const row = store.fleet.statusRow(id);
    if (row < 0 || status === null) continue;
    levels[status.level[row]] = (levels[status.level[row]] ?? 0) + 1;
    if (status.downlink[row] === kLinkLost || status.uplink[row] === kLinkLost) lost += 1;
  }
  return (
    <ul class="summary" aria-label="Summary">
      <li>{vehicles.length === 1 ? "1 UAV" : `${vehicles.length} UAVs`}</li>
      {[3, 2, 1].map((level) => {
        const count = levels[level] ?? 0;
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
