import type { Station } from "../shell/station";
import type { Store } from "../state/store";

/** A UAV by its callsign: selects it everywhere, and shows it on the map. */
export function VehicleChip({ station, id }: { station: Station; id: number }) {
  const { store, map } = station;
  const callsign = store.callsign(id);
  return (
    <button
      type="button"
      class="chip-button"
      title={`Select ${callsign} and show it on the map`}
      onClick={() => {
        store.select([id]);
        const place = placeOf(store, id);
        const at = place === null ? null : map.value?.place(place.east_m, place.north_m, place.up_m);
        if (at) map.value?.centre(at);
      }}
    >
      {callsign}
    </button>
  );
}

function placeOf(store: Store, id: number) {
  const row = store.fleet.motionRow(id);
  return row < 0 ? null : store.fleet.placeAt(row, performance.now());
}
