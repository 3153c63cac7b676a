import { Fragment } from "preact";
import { NumberField } from "../panels/number_field";
import { Icon } from "../shell/icon";
import { clock, compass } from "../units/format";
import { inChosenUnits } from "../units/station_text";
import { altitude, distance, kAltitudeReference, speed } from "../units/quantities";
import type { FlownLeg } from "./legs";
import type { PathDraft } from "./path_draft";
import { kAltitudeRange_m, kRadiusRange_m, kSpeedRange_m_s } from "./path_plan";
import type { Planner } from "./planner";
import { kKeysHint, pressOnWaypoint } from "./waypoint_keys";

/** Waypoints with what can be typed of them; between them the legs. */
export function WaypointTable({ planner, draft }: { planner: Planner; draft: PathDraft }) {
  const plan = draft.plan.value;
  const legs = planner.legs.value;
  const problems = planner.problems.value;
  const to_first = legs.find(({ from }) => from === null);
  return (
    <table class="waypoint-table">
      <caption class="visually-hidden">Waypoints and legs</caption>
      <thead>
        <tr>
          <th scope="col" title="Press a number to select its waypoint">
            #
          </th>
          <th scope="col">
            Altitude <small>{`${altitude.unit()} ${kAltitudeReference}`}</small>
          </th>
          <th scope="col">
            Speed <small>{speed.unit()}</small>
          </th>
          <th scope="col" title="Of the arc at the waypoint; auto: the smallest that all can fly in comfort">
            Turn radius <small>{distance.unit()}</small>
          </th>
          <th scope="col">
            <span class="visually-hidden">Delete</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {to_first !== undefined && <LegRow leg={to_first} climb_m={null} with_arrival />}
        {plan.waypoints.map((_, i) => {
          const leg = legs.find(({ from }) => from === i);
          return (
            <Fragment key={i}>
              <WaypointRow planner={planner} draft={draft} index={i} />
              {problems
                .filter(({ waypoint_index }) => waypoint_index === i)
                .map(({ text }) => (
                  <tr class="problem-row" key={text}>
                    <td />
                    <td colSpan={4}>
                      <Problem text={text} />
                    </td>
                  </tr>
                ))}
              {leg !== undefined && (
                <LegRow leg={leg} climb_m={climbOf(leg, draft)} with_arrival={to_first !== undefined} />
              )}
            </Fragment>
          );
        })}
      </tbody>
    </table>
  );
}

/** The server names waypoint or leg, and begins in lower case. Its mark says "can't be flown" by its shape. */
export function Problem({ text }: { text: string }) {
  return (
    <p class="plan-problem">
      <svg class="problem-mark" viewBox="0 0 16 16" role="img" aria-label="Problem:">
        <circle cx="8" cy="8" r="6" />
        <path d="M3.800 12.200l8.400-8.400" />
      </svg>{" "}
      {inChosenUnits(text.charAt(0).toUpperCase() + text.slice(1))}
    </p>
  );
}

interface WaypointRowProps {
  planner: Planner;
  draft: PathDraft;
  index: number;
}

function WaypointRow({ planner, draft, index }: WaypointRowProps) {
  const point = draft.plan.value.waypoints[index];
  if (point === undefined) return null;
  const number = index + 1;
  const selected = draft.selected.value === index;
  const broken = planner.problems.value.some(({ waypoint_index }) => waypoint_index === index);
  return (
    <tr class={`waypoint-row${selected ? " selected" : ""}`}>
      <th scope="row">
        <button
          type="button"
          class={`waypoint-number${broken ? " problem" : ""}`}
          aria-pressed={selected}
          aria-label={`Select waypoint ${number}`}
          title={`Select waypoint ${number}. ${kKeysHint}`}
          onClick={() => {
            draft.selected.value = selected ? null : index;
          }}
          onKeyDown={(event) => {
            pressOnWaypoint(draft, index, event);
          }}
        >
          {number}
        </button>
      </th>
      <td>
        <NumberField
          label={`Altitude of waypoint ${number}`}
          value={point.up_m}
          quantity={altitude}
          {...kAltitudeRange_m}
          step={10}
          decimals={1}
          commit={(up_m) => {
            draft.set(index, { up_m }, "altitude", `altitude ${index}`);
          }}
        />
      </td>
      <td>
        <NumberField
          label={`Speed at waypoint ${number}`}
          value={point.speed_m_s}
          quantity={speed}
          {...kSpeedRange_m_s}
          decimals={1}
          commit={(speed_m_s) => {
            draft.set(index, { speed_m_s }, "speed", `speed ${index}`);
          }}
        />
      </td>
      <td>
        <NumberField
          label={`Turn radius at waypoint ${number}`}
          value={point.turn_radius_m}
          quantity={distance}
          {...kRadiusRange_m}
          step={100}
          zero="auto"
          commit={(turn_radius_m) => {
            draft.set(index, { turn_radius_m }, "turn radius", `radius ${index}`);
          }}
        />
      </td>
      <td>
        <button
          type="button"
          class="bar-button"
          aria-label={`Delete waypoint ${number}`}
          title={`Delete waypoint ${number}`}
          onClick={() => {
            draft.remove(index);
          }}
        >
          <Icon name="close" />
        </button>
      </td>
    </tr>
  );
}

interface LegRowProps {
  leg: FlownLeg;
  climb_m: number | null;
  /** It is known how the leader comes to the first waypoint. */
  with_arrival: boolean;
}

function LegRow({ leg, climb_m, with_arrival }: LegRowProps) {
  const climb =
    climb_m === null || Math.abs(climb_m) < 0.5
      ? ""
      : `${climb_m > 0 ? "↗" : "↘"} ${altitude.full(Math.abs(climb_m))}`;
  const from = leg.from === null ? "the leader" : `waypoint ${leg.from + 1}`;
  return (
    <tr class="leg-row" title={`From ${from} to waypoint ${leg.to + 1}`}>
      <td aria-hidden="true">{leg.from !== null && leg.to < leg.from ? "↻" : "↓"}</td>
      <td colSpan={4}>
        <span class="leg">
          <span>{distance.full(leg.length_m)}</span>
          <span>{compass(leg.course_rad)}°</span>
          <span>{clock(leg.time_s)}</span>
          <span class="leg-climb">{climb}</span>
          {with_arrival && (
            <span class="leg-eta" title="When it is there, counted from sending">
              at +{clock(leg.arrival_s)}
            </span>
          )}
        </span>
      </td>
    </tr>
  );
}

function climbOf({ from, to }: FlownLeg, draft: PathDraft): number | null {
  const { waypoints } = draft.plan.value;
  const [start, end] = [waypoints[from ?? -1], waypoints[to]];
  return start === undefined || end === undefined ? null : end.up_m - start.up_m;
}
