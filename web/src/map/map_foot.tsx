/** Below the map: scale and grid on the left; where the cursor is, and whose map it is, on the right. */
import { useSignal } from "@preact/signals";
import type L from "leaflet";
import { useEffect, useRef } from "preact/hooks";
import { lengthInSteps, roundLength_m } from "../units/quantities";
import { enuText, latLonText, mgrsText } from "./coordinates";
import type { FleetMap } from "./fleet_map";

export function MapFoot({ map }: { map: FleetMap }) {
  const attribution = useRef<HTMLDivElement>(null);
  useEffect(() => {
    attribution.current?.replaceChildren(map.attribution);
  }, [map]);
  return (
    <>
      {map.measure.active.value && <MeasureHint map={map} />}
      <div class="map-foot">
        <Scale map={map} />
        <div class="map-foot-right">
          <Coordinates map={map} />
          <div ref={attribution} />
        </div>
      </div>
    </>
  );
}

/** How to go on; and the middle of the map, where Enter puts the next point. */
function MeasureHint({ map }: { map: FleetMap }) {
  return (
    <div class="measure-hint panel" role="status">
      <span>Click the points, or press Enter for the middle</span>
      <button
        type="button"
        class="button"
        onClick={() => {
          map.measure.addMiddle();
        }}
      >
        Add middle
      </button>
      <button
        type="button"
        class="button"
        onClick={() => {
          map.measure.takeBack();
        }}
      >
        Take back
      </button>
      <button
        type="button"
        class="button"
        title="Escape"
        onClick={() => {
          map.measure.toggle();
        }}
      >
        End
      </button>
    </div>
  );
}

/** Of the cursor; of the middle of the map while no cursor is over it. */
function Coordinates({ map }: { map: FleetMap }) {
  const told = useSignal<{ of: "Cursor" | "Middle"; at: L.LatLng } | null>(null);
  useEffect(() => {
    let cursor: L.Point | null = null;
    const tell = () => {
      // A map that moves on below a cursor that doesn't has another place there.
      told.value =
        cursor === null
          ? { of: "Middle", at: map.middle() }
          : { of: "Cursor", at: map.leaflet.containerPointToLatLng(cursor) };
    };
    const onMove = (event: L.LeafletMouseEvent) => {
      cursor = event.containerPoint;
      tell();
    };
    const onOut = () => {
      cursor = null;
      tell();
    };
    tell();
    map.leaflet.on("mousemove", onMove).on("mouseout", onOut).on("moveend zoomend resize", tell);
    return () => {
      map.leaflet.off("mousemove", onMove).off("mouseout", onOut).off("moveend zoomend resize", tell);
    };
  }, [map, told]);
  if (told.value === null) return null;
  const { of, at } = told.value;
  const place = { latitude_deg: at.lat, longitude_deg: at.lng };
  return (
    <dl class={`coordinates of-${of.toLowerCase()}`} aria-label={`${of} of the map`}>
      <dt>{of}</dt>
      <dd title="WGS-84">{latLonText(place)}</dd>
      <dt>ENU</dt>
      <dd title="From the local origin">{enuText(map.enu(at))}</dd>
      <dt>MGRS</dt>
      <dd title="Military Grid Reference System, to a metre">{mgrsText(place)}</dd>
    </dl>
  );
}

const kLongestBar_px = 120;

function Scale({ map }: { map: FleetMap }) {
  const scale = map.scale.value;
  if (scale === null) return null;
  // The longest round length that fits: half of the next round one up, or two fifths after a 2.
  const longest_m = kLongestBar_px * scale.metres_per_pixel;
  const round_m = roundLength_m(longest_m);
  const bar_m = [1, 0.5, 0.4, 0.2]
    .map((part) => round_m * part)
    .find((metres) => metres <= longest_m * 1.001);
  if (bar_m === undefined) return null;
  return (
    <div class="scale">
      <span>
        {scale.grid_m === null
          ? "Grid: latitude, longitude"
          : `Grid ${lengthInSteps(scale.grid_m, scale.grid_m)}, local ENU`}
      </span>
      <svg width={kLongestBar_px} height="8" aria-hidden="true">
        <path d={`M1 1V7H${(bar_m / scale.metres_per_pixel - 1).toFixed(1)}V1`} />
      </svg>
      <span>{lengthInSteps(bar_m, round_m)}</span>
    </div>
  );
}
