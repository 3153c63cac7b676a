import { useSignal, type Signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Outcome } from "../link/commands";
import { CommandButton } from "../panels/command_button";
import type { PanelProps } from "../shell/panel_props";
import { duration } from "../units/format";

/** GET /api/scenarios */
interface Scenario {
  name: string;
  title: string;
  description: string;
  vehicles: number;
  duration_s: number;
  problem: string;
}

/** A new flight is heard within 2 s of its command; after this long something is wrong. */
const kLongestStart_ms = 6000;

const uavs = (count: number) => (count === 1 ? "1 UAV" : `${count} UAVs`);

export function ScenarioControls({ station }: PanelProps) {
  const { store, commands } = station;
  const chosen = useSignal<Scenario | null>(null);
  /** What is about to be done, and waits for a second look. */
  const about_to = useSignal<"" | "restart" | "load">("");
  const start = useStart(station);
  const roster = store.roster.value;
  const loads = about_to.value === "load";

  const command = async (): Promise<Outcome> => {
    const before_utime = roster?.start_utime ?? 0;
    const outcome = await (loads && chosen.value !== null
      ? commands.request("CMD_SIMULATION", { action: "load", scenario: chosen.value.name })
      : commands.request("CMD_SIMULATION", { action: "restart" }));
    if (outcome.accepted) {
      about_to.value = "";
      start.begin(before_utime);
    }
    return outcome;
  };
  const opener = (what: "restart" | "load", text: string, title: string) => (
    <button
      type="button"
      class="button"
      disabled={start.waits}
      title={title}
      onClick={() => {
        chosen.value = null;
        about_to.value = what;
      }}
    >
      {text}
    </button>
  );

  return (
    <section aria-labelledby="scenario-title">
      <h3 id="scenario-title">Scenario</h3>
      <p class="now-flying">
        {roster === null ? "No fleet yet" : roster.scenario || "Without a name"}
        <span class="hint">{roster === null ? "" : uavs(roster.vehicles.length)}</span>
      </p>
      {about_to.value === "" ? (
        <div class="row">
          {opener("load", "Load another…", "Choose another scenario")}
          {opener("restart", "Restart…", "Fly the same scenario again, from its start")}
          <span class="hint" role="status">
            {start.word}
          </span>
        </div>
      ) : (
        <div class="sure" role="group" aria-label={loads ? "Load another scenario" : "Restart"}>
          {loads && <ScenarioList station={station} chosen={chosen} />}
          <p>
            {!loads
              ? "The flight ends, and the same scenario starts again."
              : chosen.value === null
                ? "Choose the scenario to fly."
                : `The flight ends, and ${chosen.value.title} starts with ${uavs(chosen.value.vehicles)}.`}
          </p>
          <div class="row">
            <CommandButton
              class="button primary"
              label={loads ? "Load now" : "Restart now"}
              disabled={loads && chosen.value === null}
              command={command}
            >
              {loads ? "Load now" : "Restart now"}
            </CommandButton>
            <button
              type="button"
              class="button"
              onClick={() => {
                about_to.value = "";
              }}
            >
              Cancel
            </button>
          </div>
        </div>
      )}
    </section>
  );
}

function ScenarioList({ station, chosen }: PanelProps & { chosen: Signal<Scenario | null> }) {
  const { scenarios, failure, read } = useScenarios(station);
  return (
    <>
      <ul class="scenarios" aria-label="Scenarios">
        {scenarios.value.map((one) => (
          <ScenarioChoice
            key={one.name}
            scenario={one}
            flying={one.title === station.store.roster.value?.scenario}
            chosen={one.name === chosen.value?.name}
            choose={() => {
              chosen.value = one;
            }}
          />
        ))}
      </ul>
      {scenarios.value.length === 0 && (
        <p class="hint" role="status">
          {failure.value || "Reading the list…"}{" "}
          {failure.value !== "" && (
            <button type="button" class="button" onClick={read}>
              Try again
            </button>
          )}
        </p>
      )}
    </>
  );
}

interface ChoiceProps {
  scenario: Scenario;
  flying: boolean;
  chosen: boolean;
  choose: () => void;
}

function ScenarioChoice({ scenario, flying, chosen, choose }: ChoiceProps) {
  const { name, title, description, vehicles, duration_s, problem } = scenario;
  return (
    <li>
      <label class={chosen ? "scenario-choice chosen" : "scenario-choice"} title={problem || description}>
        <input type="radio" name="scenario" checked={chosen} disabled={problem !== ""} onChange={choose} />
        <span class="scenario-name">
          {title || name}
          {flying && <span class="tag">flying</span>}
        </span>
        <span class="hint">
          {problem === "" ? `${uavs(vehicles)}, ${duration(duration_s)}` : "cannot be flown"}
        </span>
        <span class="scenario-description hint">{problem || description}</span>
      </label>
    </li>
  );
}

function useScenarios({ api }: PanelProps["station"]) {
  const scenarios = useSignal<readonly Scenario[]>([]);
  const failure = useSignal("");
  const read = () => {
    failure.value = "";
    api
      .getJson<Scenario[]>("api/scenarios")
      .then((list) => {
        scenarios.value = list;
        if (list.length === 0)
          failure.value = "web-bridge finds no scenario on its machine (SKEIN_SCENARIOS).";
      })
      .catch((error: unknown) => {
        failure.value = error instanceof Error ? error.message : String(error);
      });
  };
  const first = useRef(read);
  useEffect(() => {
    first.current();
  }, []);
  return { scenarios, failure, read };
}

/** Between the answer and the roster of the new flight. */
function useStart({ store }: PanelProps["station"]) {
  const since = useSignal<{ before_utime: number; at_ms: number } | null>(null);
  const started = since.value !== null && (store.roster.value?.start_utime ?? 0) !== since.value.before_utime;
  const late = since.value !== null && !started && store.now_ms.value - since.value.at_ms > kLongestStart_ms;
  return {
    waits: since.value !== null && !started && !late,
    word:
      since.value === null
        ? ""
        : started
          ? "Started."
          : late
            ? "Accepted, but no new fleet was heard."
            : "Starting…",
    begin(before_utime: number) {
      since.value = { before_utime, at_ms: performance.now() };
    },
  };
}
