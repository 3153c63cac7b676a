/** What the map shows: base map, layers, trails. */
import { Popover } from "../shell/popover";
import { Choice } from "../shell/settings_menu";
import type { Store } from "../state/store";
import type { FleetMap } from "./fleet_map";
import { base_map, layers, trail_min, trails_of } from "./layers";
import { baseChoices, baseInForce } from "./tile_layers";
import { kLongestTrail_min } from "./trails";

export function LayersMenu({ map, store }: { map: FleetMap; store: Store }) {
  const icon = (
    <svg viewBox="0 0 16 16" aria-hidden="true">
      <path d="M8 2l6 3.200-6 3.200-6-3.200zM2 8.200l6 3.200 6-3.200M2 11l6 3.200 6-3.200" />
    </svg>
  );
  return (
    <Popover label="Layers of the map" button={icon} class="icon-button">
      <BaseMaps map={map} store={store} />
      <h2>Layers</h2>
      <div class="layer-list">
        {Object.values(layers).map(({ label, shown }) => (
          <label key={label}>
            <input
              type="checkbox"
              checked={shown.value}
              onChange={() => {
                shown.value = !shown.value;
              }}
            />
            {label}
          </label>
        ))}
      </div>
      <h2>Trails</h2>
      <Choice
        label="Trails of"
        value={trails_of}
        choices={[
          ["all", "All"],
          ["selected", "Selected"],
          ["none", "None"],
        ]}
      />
      <label class="choice">
        Length
        <span class="trail-length">
          <input
            type="range"
            min={1}
            max={kLongestTrail_min}
            value={trail_min.value}
            aria-label="Length of trails in minutes"
            onInput={(event) => {
              trail_min.value = event.currentTarget.valueAsNumber;
            }}
          />
          <output>{trail_min.value} min</output>
        </span>
      </label>
    </Popover>
  );
}

function BaseMaps({ map, store }: { map: FleetMap; store: Store }) {
  const hello = store.hello.value;
  const choices = baseChoices(hello);
  const in_force = baseInForce(hello, base_map.value);
  return (
    <>
      <h2>Base map</h2>
      <div class="layer-list" role="radiogroup" aria-label="Base map">
        {choices.map(({ base, label }) => (
          <label key={base}>
            <input
              type="radio"
              name="base-map"
              checked={base === in_force}
              onChange={() => {
                base_map.value = base;
              }}
            />
            {label}
          </label>
        ))}
      </div>
      {choices.length === 1 && (
        <p class="hint">
          For a map of your own start <code>web-bridge --tiles</code> with a folder of tiles or a PMTiles
          file.
        </p>
      )}
      {map.base_problem.value !== "" && <p class="hint problem">{map.base_problem.value}</p>}
    </>
  );
}
