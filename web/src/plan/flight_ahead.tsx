import { kLeftOut, kLimitNames } from "../panels/flight_ahead";
import { clock, duration } from "../units/format";
import { altitude, distance } from "../units/quantities";
import type { PathPlan } from "./path_plan";
import type { Planner } from "./planner";
import type { FlightPreview } from "./preview";

/** What the flight ahead of a plan has found: least separation, limits that bind. */
export function FlightAhead({ planner, plan }: { planner: Planner; plan: PathPlan }) {
  const { preview } = planner;
  const flight = preview.flight.value;
  if (planner.draft.value?.changed.value !== true)
    return <p class="plan-line hint">This is the path that is flown.</p>;
  if (preview.failure.value !== "") return <p class="plan-line">{preview.failure.value}</p>;
  if (flight?.plan !== plan) {
    return (
      <p class="plan-line" aria-live="polite">
        {planner.problems.value.length === 0 && (
          <>
            <progress aria-label="Flying the formation ahead" /> Flying the formation ahead…
          </>
        )}
      </p>
    );
  }
  const { store } = planner;
  const age_s = (store.now_ms.value - flight.at_ms) / 1000;
  return (
    <div class="plan-flight">
      <LeastSeparation planner={planner} flight={flight.preview} />
      {limitsText(flight.preview, (id) => store.callsign(id)).map((line) => (
        <p key={line}>{line}</p>
      ))}
      <p class="hint">
        Flown ahead for {duration(flight.preview.duration_s)}
        {flight.preview.complete ? "" : ", not to its end"}, from {duration(Math.max(age_s, 0))} ago.{" "}
        {kLeftOut}
      </p>
    </div>
  );
}

function LeastSeparation({ planner, flight }: { planner: Planner; flight: FlightPreview }) {
  const { least } = flight;
  if (least === null) return <p>Nobody else comes near.</p>;
  const [a, b] = least.ids.map((id) => planner.store.callsign(id));
  return (
    <p class={least.inside_cylinder ? "inside-cylinder" : ""}>
      Least separation{" "}
      <b>
        R {distance.full(least.horizontal_m)}, H {altitude.full(least.vertical_m)}
      </b>
      : {a} and {b}, {clock(least.t_s)} after sending
      {least.inside_cylinder ? "; inside the cylinder." : "."}
    </p>
  );
}

/** One line a limit: who, and for how long. */
function limitsText({ limits }: FlightPreview, callsign: (id: number) => string): string[] {
  const by_limit = new Map<string, { ids: string[]; seconds: number }>();
  for (const { vehicle_id, limit, seconds } of limits) {
    const known = by_limit.get(limit) ?? { ids: [], seconds: 0 };
    by_limit.set(limit, {
      ids: [...known.ids, callsign(vehicle_id)],
      seconds: Math.max(known.seconds, seconds),
    });
  }
  return [...by_limit].map(
    ([limit, { ids, seconds }]) =>
      `Out of its slot at a limit (${kLimitNames[limit] ?? limit}): ${ids.join(", ")} for up to ${duration(seconds)}.`,
  );
}
