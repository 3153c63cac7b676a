import { useShortcuts } from "../shell/shortcuts";
import type { Station } from "../shell/station";
import type { PathDraft } from "./path_draft";
import { kStraightOn, leastWaypoints } from "./path_plan";
import type { Planner } from "./planner";
import { showPath } from "./show_path";

interface PlanToolsProps {
  station: Station;
  planner: Planner;
  draft: PathDraft;
}

/** What is done to the path as a whole, with one press. */
export function PlanTools({ station, planner, draft }: PlanToolsProps) {
  const { closed, waypoints } = draft.plan.value;
  const addAtCentre = () => {
    const map = station.map.peek();
    const free = map?.freeArea();
    const whole = map?.leaflet.getContainer().getBoundingClientRect();
    if (map === null || map === undefined || free === undefined || whole === undefined) return;
    const centre = map.leaflet.containerPointToLatLng([
      (free.left + free.right) / 2 - whole.left,
      (free.top + free.bottom) / 2 - whole.top,
    ]);
    const place = map.enu(centre);
    if (place !== null) planner.append(place);
  };
  return (
    <>
      <div class="plan-tools" role="toolbar" aria-label="Path">
        <button
          type="button"
          class="button"
          aria-pressed={planner.drawing.value}
          title="Add waypoints by clicking on the map (W)"
          onClick={() => {
            planner.toggleDrawing();
          }}
        >
          Draw
        </button>
        <button
          type="button"
          class="button"
          title="Add a waypoint in the middle of the map"
          onClick={addAtCentre}
        >
          Add
        </button>
        <button
          type="button"
          class="button"
          aria-pressed={closed}
          disabled={!closed && waypoints.length < leastWaypoints(true)}
          title={
            waypoints.length < leastWaypoints(true)
              ? "A loop needs three waypoints"
              : "Fly it round and round"
          }
          onClick={() => {
            draft.setClosed(!closed);
          }}
        >
          Loop
        </button>
        <button
          type="button"
          class="button"
          disabled={waypoints.length === 0}
          title="Drop all waypoints: the formation flies straight on"
          onClick={() => {
            draft.replace(kStraightOn, "straight on");
          }}
        >
          Clear
        </button>
        <button
          type="button"
          class="button"
          disabled={waypoints.length === 0}
          title="Show the whole path on the map"
          onClick={() => {
            showPath(station.map.peek(), draft.plan.peek());
          }}
        >
          Fit
        </button>
        <button
          type="button"
          class="button"
          disabled={!draft.changed.value}
          title="Take the path that is flown as the draft"
          onClick={() => {
            draft.takeFlown();
          }}
        >
          Revert
        </button>
      </div>
      {planner.drawing.value && <DrawingHint planner={planner} />}
    </>
  );
}

/** Says how to go on, and lets Escape end it. */
function DrawingHint({ planner }: { planner: Planner }) {
  const end = () => {
    planner.drawing.value = false;
  };
  useShortcuts([{ keys: "Escape", label: "End adding waypoints", group: "Plan", run: end }]);
  return (
    <p class="plan-line hint">Click on the map to add a waypoint, on a leg to insert one. Esc ends it.</p>
  );
}
