import { useSignal } from "@preact/signals";
import { NumberField } from "../panels/number_field";
import { altitude, distance, kAltitudeReference, speed, type Quantity } from "../units/quantities";
import type { PathDraft } from "./path_draft";
import { kAltitudeRange_m, kSpeedRange_m_s } from "./path_plan";

const kTurn: Quantity = {
  unit: () => "°",
  value: (radians) => (radians * 180) / Math.PI,
  text: (radians, decimals = 0) => ((radians * 180) / Math.PI).toFixed(decimals),
  full: (radians, decimals = 0) => `${((radians * 180) / Math.PI).toFixed(decimals)}°`,
  toSi: (degrees) => (degrees * Math.PI) / 180,
};
const kFarthestMove_m = 100_000;

/** What is done to all waypoints at once. */
export function WholePath({ draft }: { draft: PathDraft }) {
  const { waypoints } = draft.plan.value;
  const east_m = useSignal(0);
  const north_m = useSignal(0);
  const turn_rad = useSignal(Math.PI / 18);
  /** The value that all have; null: they differ. */
  const common = (key: "up_m" | "speed_m_s") => {
    const first = waypoints[0]?.[key] ?? null;
    return waypoints.every((point) => point[key] === first) ? first : null;
  };
  return (
    <>
      <div class="plan-fields">
        <label>
          <span>
            Altitude of all <small>{`${altitude.unit()} ${kAltitudeReference}`}</small>
          </span>
          <NumberField
            label="Altitude of all waypoints"
            value={common("up_m")}
            quantity={altitude}
            {...kAltitudeRange_m}
            step={10}
            commit={(up_m) => {
              draft.setAll({ up_m }, "altitude");
            }}
          />
        </label>
        <label>
          <span>
            Speed of all <small>{speed.unit()}</small>
          </span>
          <NumberField
            label="Speed at all waypoints"
            value={common("speed_m_s")}
            quantity={speed}
            {...kSpeedRange_m_s}
            decimals={1}
            commit={(speed_m_s) => {
              draft.setAll({ speed_m_s }, "speed");
            }}
          />
        </label>
      </div>
      <div class="plan-fields">
        <label>
          <span>
            East by <small>{distance.unit()}</small>
          </span>
          <NumberField
            label="Move the path east by"
            value={east_m.value}
            quantity={distance}
            least={-kFarthestMove_m}
            most={kFarthestMove_m}
            step={100}
            commit={(value) => {
              east_m.value = value;
            }}
          />
        </label>
        <label>
          <span>
            North by <small>{distance.unit()}</small>
          </span>
          <NumberField
            label="Move the path north by"
            value={north_m.value}
            quantity={distance}
            least={-kFarthestMove_m}
            most={kFarthestMove_m}
            step={100}
            commit={(value) => {
              north_m.value = value;
            }}
          />
        </label>
        <button
          type="button"
          class="button"
          disabled={east_m.value === 0 && north_m.value === 0}
          onClick={() => {
            draft.move(east_m.value, north_m.value);
          }}
        >
          Move
        </button>
      </div>
      <div class="plan-fields">
        <label>
          <span>
            Turn by <small>° clockwise</small>
          </span>
          <NumberField
            label="Turn the path clockwise by"
            value={turn_rad.value}
            quantity={kTurn}
            least={-2 * Math.PI}
            most={2 * Math.PI}
            step={5}
            decimals={1}
            commit={(value) => {
              turn_rad.value = value;
            }}
          />
        </label>
        <button
          type="button"
          class="button"
          onClick={() => {
            draft.rotate(turn_rad.value);
          }}
        >
          Turn
        </button>
        <button
          type="button"
          class="button"
          title="Fly it the other way round"
          onClick={() => {
            draft.reverse();
          }}
        >
          Reverse
        </button>
      </div>
    </>
  );
}
