/** The buttons beside the map. */
import type { Store } from "../state/store";
import type { FleetMap } from "./fleet_map";
import { LayersMenu } from "./layers_menu";

const kIcons = {
  zoom_in: "M8 3v10M3 8h10",
  zoom_out: "M3 8h10",
  fit: "M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4",
  follow: "M8 1v4M8 11v4M1 8h4M11 8h4M8 3.500a4.500 4.500 0 1 0 .01 0",
  box: "M2 5V2h3M7 2h2M11 2h3v3M14 7v2M14 11v3h-3M9 14H7M5 14H2v-3M2 9V7",
  measure: "M1.500 10.500l9-9 4 4-9 9zM4 8l1.500 1.500M6.500 5.500L9 8M9 3l1.500 1.500",
} as const;

export function MapTools({ map, store }: { map: FleetMap; store: Store }) {
  return (
    <div class="map-tools">
      <div class="panel button-column" role="toolbar" aria-label="Map" aria-orientation="vertical">
        <ToolButton
          label="Zoom in"
          keys="+"
          icon="zoom_in"
          run={() => {
            map.zoom(0.5);
          }}
        />
        <ToolButton
          label="Zoom out"
          keys="−"
          icon="zoom_out"
          run={() => {
            map.zoom(-0.5);
          }}
        />
        <ToolButton
          label="Fit the map to the fleet"
          keys="F"
          icon="fit"
          run={() => {
            map.fit();
          }}
        />
        <ToolButton
          label="Follow the fleet"
          keys="L"
          icon="follow"
          pressed={map.following.value}
          run={() => {
            map.following.value = !map.following.value;
          }}
        />
        <ToolButton
          label="Select with a box"
          keys="B, or Shift and drag"
          icon="box"
          pressed={map.box.active.value}
          run={() => {
            map.box.toggle();
          }}
        />
        <ToolButton
          label="Measure"
          keys="M"
          icon="measure"
          pressed={map.measure.active.value}
          run={() => {
            map.measure.toggle();
          }}
        />
        <LayersMenu map={map} store={store} />
      </div>
    </div>
  );
}

interface ToolButtonProps {
  label: string;
  keys: string;
  icon: keyof typeof kIcons;
  pressed?: boolean;
  run: () => void;
}

function ToolButton({ label, keys, icon, pressed, run }: ToolButtonProps) {
  return (
    <button
      type="button"
      class="icon-button"
      title={`${label} (${keys})`}
      aria-label={label}
      aria-pressed={pressed}
      onClick={run}
    >
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d={kIcons[icon]} />
      </svg>
    </button>
  );
}
