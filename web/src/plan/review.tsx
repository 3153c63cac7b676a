import { CommandButton } from "../panels/command_button";
import { clock } from "../units/format";
import { distance } from "../units/quantities";
import { differences } from "./compare";
import { FlightAhead } from "./flight_ahead";
import { totalsOf } from "./legs";
import type { PathDraft } from "./path_draft";
import type { PathPlan } from "./path_plan";
import type { Planner } from "./planner";
import { Problem } from "./waypoint_table";

interface ReviewProps {
  planner: Planner;
  draft: PathDraft;
  plan: PathPlan;
}

/** The step between drawing and flying: what changes, what is known of it, then send. Afterwards what the bus says. */
export function Review({ planner, draft, plan }: ReviewProps) {
  const name = planner.formation_name.value;
  const upload = planner.upload.value;
  const sent = upload.kind !== "none";
  const problems = planner.problems.value;
  const { length_m, time_s } = totalsOf(planner.legs.value);
  const why_not = planner.why_not.value;
  return (
    <div class="plan-review">
      <h3>{sent ? `Sent to ${name}` : `Review for ${name}`}</h3>
      {!sent && (
        <>
          <ul class="plan-changes" aria-label="What changes">
            {differences(draft.flown.value, plan).map((line) => (
              <li key={line}>{line}</li>
            ))}
            {!draft.changed.value && <li>Nothing: this is what is flown.</li>}
          </ul>
          {plan.waypoints.length > 0 && (
            <p>
              {plan.waypoints.length} waypoints, {distance.full(length_m)}, {clock(time_s)}
              {plan.closed ? ", then round and round." : ", then a circle at the end."}
            </p>
          )}
          {problems.map(({ text }) => (
            <Problem key={text} text={text} />
          ))}
          <FlightAhead planner={planner} plan={plan} />
        </>
      )}
      <UploadState planner={planner} />
      <div class="plan-actions">
        <button
          type="button"
          class="button"
          onClick={() => {
            planner.endReview();
          }}
        >
          {sent ? "Done" : "Back to planning"}
        </button>
        {!sent && (
          <CommandButton
            class="button primary"
            label={`Send to ${name}`}
            command={() => planner.send()}
            disabled={why_not !== ""}
          >
            Send to {name}
          </CommandButton>
        )}
      </div>
      {!sent && why_not !== "" && <p class="hint">{why_not}</p>}
    </div>
  );
}

function UploadState({ planner }: { planner: Planner }) {
  const upload = planner.upload.value;
  switch (upload.kind) {
    case "none":
      return null;
    case "reading back":
      return (
        <p role="status">
          <progress aria-label="Reading back" /> Accepted. Reading back what is flown…
        </p>
      );
    case "flown":
      return (
        <p role="status" class="plan-flown">
          <b>Flown as reviewed</b>: the path on the bus (revision {upload.path_revision}) is the one that was
          sent.
        </p>
      );
    case "differs":
      return (
        <div role="alert" class="plan-note">
          <p>
            <b>Accepted, but what is flown differs from what was sent:</b>
          </p>
          {upload.differences.map((line) => (
            <p key={line}>{line}</p>
          ))}
        </div>
      );
    case "silent":
      return (
        <p role="alert" class="plan-note">
          Accepted, but the bus tells of no new path within 5 s. Look at the map and the mode before you go
          on.
        </p>
      );
  }
}
