import { useEffect } from "preact/hooks";
import type { PanelProps } from "../shell/panel_props";
import { useShortcuts } from "../shell/shortcuts";
import { clock } from "../units/format";
import { distance } from "../units/quantities";
import { FileTools } from "./file_tools";
import { FlightAhead } from "./flight_ahead";
import { totalsOf } from "./legs";
import { MapEditor } from "./map_editor";
import type { PathDraft } from "./path_draft";
import { plannerOf, type Planner } from "./planner";
import { PlanTools } from "./plan_tools";
import { ProfileChart } from "./profile_chart";
import { showPath } from "./show_path";
import { Review } from "./review";
import { WaypointPlace } from "./waypoint_place";
import { WaypointTable } from "./waypoint_table";
import { WholePath } from "./whole_path";
import "./plan.css";

/** Draws, checks, reviews and sends the path of a formation. */
export function PlanPanel({ station }: PanelProps) {
  const planner = plannerOf(station);
  const map = station.map.value;
  useEffect(() => planner.watch(), [planner]);
  useEffect(() => {
    if (map === null) return;
    const editor = new MapEditor(map, planner);
    return () => {
      editor.remove();
    };
  }, [map, planner]);

  const draft = planner.draft.value;
  if (draft === null) {
    return (
      <p class="empty">
        There is no formation whose path could be planned. Start one, or wait for the controller.
      </p>
    );
  }
  const review = planner.review.value;
  return (
    <div class="plan">
      <PlanHead planner={planner} draft={draft} />
      {review === null ? (
        <PlanEditor station={station} planner={planner} draft={draft} />
      ) : (
        <Review planner={planner} draft={draft} plan={review} />
      )}
    </div>
  );
}

interface PartProps {
  planner: Planner;
  draft: PathDraft;
}

function PlanHead({ planner, draft }: PartProps) {
  const { undo_label, redo_label } = draft.history;
  useShortcuts([
    { keys: "Ctrl+z", label: "Undo", group: "Plan", run: () => planner.draft.peek()?.undo(), repeats: true },
    {
      keys: "Ctrl+Shift+z",
      label: "Redo",
      group: "Plan",
      run: () => planner.draft.peek()?.redo(),
      repeats: true,
    },
    {
      keys: "w",
      label: "Add waypoints by clicking: on or off",
      group: "Plan",
      run: () => planner.toggleDrawing(),
    },
    {
      keys: "Delete",
      label: "Delete the selected waypoint",
      group: "Plan",
      run: () => planner.removeSelected(),
    },
  ]);
  const formations = planner.formations.value;
  return (
    <div class="plan-head">
      <select
        aria-label="Formation whose path is planned"
        value={String(planner.formation_id.value ?? "")}
        onChange={(event) => {
          planner.choose(Number(event.currentTarget.value));
        }}
      >
        {formations.map(({ id, name }) => (
          <option key={id} value={String(id)}>
            {name}
          </option>
        ))}
      </select>
      <span class="button-pair">
        <button
          type="button"
          class="button"
          disabled={undo_label.value === null}
          title={undo_label.value === null ? "Nothing to undo" : `Undo: ${undo_label.value} (Ctrl+Z)`}
          onClick={() => {
            draft.undo();
          }}
        >
          Undo
        </button>
        <button
          type="button"
          class="button"
          disabled={redo_label.value === null}
          title={
            redo_label.value === null ? "Nothing to do again" : `Redo: ${redo_label.value} (Ctrl+Shift+Z)`
          }
          onClick={() => {
            draft.redo();
          }}
        >
          Redo
        </button>
      </span>
    </div>
  );
}

function PlanEditor({ station, planner, draft }: PartProps & PanelProps) {
  const plan = draft.plan.value;
  const count = plan.waypoints.length;
  return (
    <>
      {draft.overtaken.value && <Overtaken planner={planner} draft={draft} />}
      <PlanTools station={station} planner={planner} draft={draft} />
      {count === 0 ? (
        <p class="plan-empty">
          <b>Straight on.</b> Without waypoints the formation keeps its course. Add waypoints by clicking on
          the map (W), by a long press, or open a file.
        </p>
      ) : (
        <>
          <WaypointTable planner={planner} draft={draft} />
          <WaypointPlace station={station} draft={draft} />
          {count > 1 && <ProfileChart planner={planner} draft={draft} />}
          <details class="plan-details">
            <summary>Whole path: altitude, speed, move, turn</summary>
            <WholePath draft={draft} />
          </details>
        </>
      )}
      <FileTools station={station} planner={planner} />
      <PlanFoot planner={planner} draft={draft} />
    </>
  );
}

function Overtaken({ planner, draft }: PartProps) {
  const { closed, waypoints } = draft.flown.value;
  const what =
    waypoints.length === 0 ? "straight on" : `${waypoints.length} waypoints${closed ? ", a loop" : ""}`;
  return (
    <div class="plan-note" role="alert">
      <p>
        <b>{planner.formation_name.value} flies another path now</b> ({what}) than when you began this one.
      </p>
      <div class="plan-actions">
        <button
          type="button"
          class="button"
          onClick={() => {
            draft.takeFlown();
          }}
        >
          Take that one
        </button>
        <button
          type="button"
          class="button"
          onClick={() => {
            draft.keepMine();
          }}
        >
          Keep mine
        </button>
      </div>
    </div>
  );
}

function PlanFoot({ planner, draft }: PartProps) {
  const plan = draft.plan.value;
  const { length_m, time_s } = totalsOf(planner.legs.value);
  const problems = planner.problems.value.length;
  return (
    <footer class="plan-foot">
      <p class="plan-total">
        <span>
          Total <b>{distance.full(length_m)}</b>
        </span>
        <span>
          Time <b>{clock(time_s)}</b>
        </span>
        {!planner.legs.value.some(({ from }) => from === null) && plan.waypoints.length > 1 && (
          <span
            class="hint"
            title="From the first waypoint on, without arcs; as it is flown once it is checked"
          >
            straight lines
          </span>
        )}
        {problems > 0 && <b>{problems === 1 ? "1 problem" : `${problems} problems`}</b>}
      </p>
      <FlightAhead planner={planner} plan={plan} />
      <div class="plan-actions">
        <button
          type="button"
          class="button primary"
          disabled={!draft.changed.value}
          title={draft.changed.value ? "Look it over before it is sent" : "This is what is flown"}
          onClick={() => {
            planner.startReview();
            showPath(planner.station.map.peek(), plan);
          }}
        >
          Review…
        </button>
      </div>
    </footer>
  );
}
