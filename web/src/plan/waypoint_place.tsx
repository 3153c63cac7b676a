import { NumberField } from "../panels/number_field";
import type { Station } from "../shell/station";
import { Choice } from "../shell/settings_menu";
import { oneOf, remembered } from "../state/remembered";
import { wrapped } from "../units/geodesy";
import { distance, farDistance, type Quantity } from "../units/quantities";
import { isNearby, toLocal } from "./path_file";
import type { PathDraft } from "./path_draft";
import { kFarthest_m } from "./path_plan";

type PlaceKind = "enu" | "geo";
const place_kind = remembered<PlaceKind>("plan.place", "enu", oneOf("enu", "geo"));

const kDegrees: Quantity = {
  unit: () => "°",
  value: (degrees) => degrees,
  text: (degrees, decimals = 6) => degrees.toFixed(decimals),
  full: (degrees, decimals = 6) => `${degrees.toFixed(decimals)}°`,
  toSi: (degrees) => degrees,
};

interface WaypointPlaceProps {
  station: Station;
  draft: PathDraft;
}

/** Where the selected waypoint is, in metres from the origin or in degrees. */
export function WaypointPlace({ station, draft }: WaypointPlaceProps) {
  const index = draft.selected.value;
  const point = index === null ? undefined : draft.plan.value.waypoints[index];
  if (index === null || point === undefined) return null;
  const number = index + 1;
  const frame = station.map.value?.frame() ?? null;
  const move = (place: { east_m?: number; north_m?: number }) => {
    draft.set(index, place, "place", `place ${index}`);
  };
  const at = frame?.toLatLon(point.east_m, point.north_m, point.up_m);
  const moveTo = (latitude_deg: number, longitude_deg: number) => {
    if (frame === null) return;
    const { east_m, north_m } = toLocal(frame, { latitude_deg, longitude_deg, up_m: point.up_m });
    move({ east_m, north_m });
  };
  // By distance: degrees of longitude become short towards the poles.
  const check = (latitude_deg: number, longitude_deg: number) =>
    frame === null || isNearby(frame, { latitude_deg, longitude_deg, up_m: point.up_m })
      ? null
      : `More than ${farDistance(kFarthest_m)} from the origin.`;
  return (
    <fieldset class="plan-group" key={number}>
      <legend>{`Waypoint ${number}`}</legend>
      <Choice
        label="Place"
        value={place_kind}
        choices={[
          ["enu", "East, north"],
          ["geo", "Lat, lon"],
        ]}
      />
      {place_kind.value === "enu" || at === undefined || frame === null ? (
        <div class="plan-fields">
          <label>
            <span>
              East <small>{distance.unit()}</small>
            </span>
            <NumberField
              label={`East of waypoint ${number}`}
              value={point.east_m}
              quantity={distance}
              least={-kFarthest_m}
              most={kFarthest_m}
              step={10}
              decimals={1}
              commit={(east_m) => {
                move({ east_m });
              }}
            />
          </label>
          <label>
            <span>
              North <small>{distance.unit()}</small>
            </span>
            <NumberField
              label={`North of waypoint ${number}`}
              value={point.north_m}
              quantity={distance}
              least={-kFarthest_m}
              most={kFarthest_m}
              step={10}
              decimals={1}
              commit={(north_m) => {
                move({ north_m });
              }}
            />
          </label>
        </div>
      ) : (
        <div class="plan-fields">
          <label>
            <span>
              Latitude <small>°</small>
            </span>
            <NumberField
              label={`Latitude of waypoint ${number}`}
              value={at.latitude_deg}
              quantity={kDegrees}
              least={-90}
              most={90}
              check={(latitude_deg) => check(latitude_deg, at.longitude_deg)}
              step={0.0001}
              decimals={6}
              commit={(latitude_deg) => {
                moveTo(latitude_deg, at.longitude_deg);
              }}
            />
          </label>
          <label>
            <span>
              Longitude <small>°</small>
            </span>
            <NumberField
              label={`Longitude of waypoint ${number}`}
              value={wrapped(at.longitude_deg)}
              quantity={kDegrees}
              least={-180}
              most={180}
              check={(longitude_deg) => check(at.latitude_deg, longitude_deg)}
              step={0.0001}
              decimals={6}
              commit={(longitude_deg) => {
                moveTo(at.latitude_deg, longitude_deg);
              }}
            />
          </label>
        </div>
      )}
    </fieldset>
  );
}
