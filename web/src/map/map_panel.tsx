import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Station } from "../shell/station";
import { useShortcuts } from "../shell/shortcuts";
import { length } from "../units/format";
import { FleetMap } from "./fleet_map";
import { niceStep } from "./view";

interface MapPanelProps {
  station: Station;
  freeArea: () => DOMRect;
}

export function MapPanel({ station, freeArea }: MapPanelProps) {
  const container = useRef<HTMLDivElement>(null);
  const map = useSignal<FleetMap | null>(null);

  useEffect(() => {
    if (container.current === null) return;
    const made = new FleetMap(container.current, station.store, freeArea);
    map.value = made;
    station.map.value = made;
    return () => {
      station.map.value = null;
      map.value = null;
      made.remove();
    };
  }, [station, freeArea, map]);

  useShortcuts([
    { keys: "f", label: "Fit the map to the fleet", group: "Map", run: () => map.value?.fit() },
    {
      keys: "l",
      label: "Follow the fleet",
      group: "Map",
      run: () => {
        toggleFollow(map.value);
      },
    },
  ]);

  return (
    <>
      <div class="map" ref={container} role="application" aria-label="Map of the fleet" />
      {map.value !== null && <MapTools map={map.value} />}
      {map.value !== null && <MapFoot map={map.value} />}
    </>
  );
}

function toggleFollow(map: FleetMap | null): void {
  if (map !== null) map.following.value = !map.following.value;
}

function MapTools({ map }: { map: FleetMap }) {
  return (
    <div class="map-tools">
      <div class="panel button-column" role="toolbar" aria-label="Map" aria-orientation="vertical">
        <button
          type="button"
          class="icon-button"
          title="Zoom in (+)"
          aria-label="Zoom in"
          onClick={() => {
            map.zoom(0.5);
          }}
        >
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d="M8 3v10M3 8h10" />
          </svg>
        </button>
        <button
          type="button"
          class="icon-button"
          title="Zoom out (−)"
          aria-label="Zoom out"
          onClick={() => {
            map.zoom(-0.5);
          }}
        >
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d="M3 8h10" />
          </svg>
        </button>
        <button
          type="button"
          class="icon-button"
          title="Fit the map to the fleet (F)"
          aria-label="Fit the map to the fleet"
          onClick={() => {
            map.fit();
          }}
        >
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d="M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4" />
          </svg>
        </button>
        <button
          type="button"
          class="icon-button"
          title="Follow the fleet (L)"
          aria-label="Follow the fleet"
          aria-pressed={map.following.value}
          onClick={() => {
            toggleFollow(map);
          }}
        >
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <circle cx="8" cy="8" r="4.500" />
            <path d="M8 1v4M8 11v4M1 8h4M11 8h4" />
          </svg>
        </button>
      </div>
    </div>
  );
}

/** Below the map: scale and grid on the left, whose map it is on the right. */
function MapFoot({ map }: { map: FleetMap }) {
  const attribution = useRef<HTMLDivElement>(null);
  useEffect(() => {
    attribution.current?.replaceChildren(map.attribution);
  }, [map]);
  return (
    <div class="map-foot">
      <Scale map={map} />
      <div ref={attribution} />
    </div>
  );
}

const kLongestBar_px = 120;

function Scale({ map }: { map: FleetMap }) {
  const scale = map.scale.value;
  if (scale === null) return null;
  // The longest round length that fits: half of the next round one up, or two fifths after a 2.
  const bar_m = [1, 0.5, 0.4, 0.2]
    .map((part) => niceStep(kLongestBar_px * scale.metres_per_pixel) * part)
    .find((metres) => metres <= kLongestBar_px * scale.metres_per_pixel * 1.001);
  if (bar_m === undefined) return null;
  return (
    <div class="scale">
      <span>
        {scale.grid_m === null ? "Grid: latitude, longitude" : `Grid ${length(scale.grid_m)}, local ENU`}
      </span>
      <svg width={kLongestBar_px} height="8" aria-hidden="true">
        <path d={`M1 1V7H${(bar_m / scale.metres_per_pixel - 1).toFixed(1)}V1`} />
      </svg>
      <span>{length(bar_m)}</span>
    </div>
  );
}
