import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Outcome } from "../link/commands";
import { CommandButton } from "../panels/command_button";
import type { PanelProps } from "../shell/panel_list";
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
  const { scenarios, failure, read } = useScenarios(station);
  const chosen = useSignal("");
  const sure_of = useSignal<"" | "restart" | "load">("");
  const start = useStart(station);
  const roster = store.roster.value;
  const scenario = scenarios.value.find(({ name }) => name === chosen.value);

  const command = async (): Promise<Outcome> => {
    const before_utime = roster?.start_utime ?? 0;
    const outcome = await (sure_of.value === "load" && scenario !== undefined
      ? commands.request("CMD_SIMULATION", { action: "load", scenario: scenario.name })
      : commands.request("CMD_SIMULATION", { action: "restart" }));
    if (outcome.accepted) {
      sure_of.value = "";
      start.begin(before_utime);
    }
    return outcome;
  };

  return (
    <section aria-labelledby="scenario-title">
      <h3 id="scenario-title">Scenario</h3>
      <p class="now-flying">
        {roster === null ? "No fleet yet" : roster.scenario || "Without a name"}
        <span class="hint">{roster === null ? "" : uavs(roster.vehicles.length)}</span>
      </p>
      <ul class="scenarios" role="radiogroup" aria-label="Scenarios">
        {scenarios.value.map((one) => (
          <ScenarioChoice
            key={one.name}
            scenario={one}
            flying={one.title === roster?.scenario}
            chosen={one.name === chosen.value}
            choose={() => {
              chosen.value = one.name;
              sure_of.value = "";
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
      {sure_of.value === "" ? (
        <div class="row">
          <button
            type="button"
            class="button"
            disabled={scenario === undefined || start.waits}
            title={scenario === undefined ? "Choose a scenario first" : `Fly ${scenario.title}`}
            onClick={() => {
              sure_of.value = "load";
            }}
          >
            Load…
          </button>
          <button
            type="button"
            class="button"
            disabled={start.waits}
            title="Fly the same scenario again, from its start"
            onClick={() => {
              sure_of.value = "restart";
            }}
          >
            Restart…
          </button>
          <span class="hint" role="status">
            {start.word}
          </span>
        </div>
      ) : (
        <div class="sure" role="group" aria-label="Are you sure?">
          <p>
            {sure_of.value === "load" && scenario !== undefined
              ? `The flight ends, and ${scenario.title} starts with ${uavs(scenario.vehicles)}.`
              : "The flight ends, and the same scenario starts again."}{" "}
            Everybody who looks on sees it.
          </p>
          <div class="row">
            <CommandButton
              class="button primary"
              label={sure_of.value === "load" ? "Load now" : "Restart now"}
              command={command}
            >
              {sure_of.value === "load" ? "Load now" : "Restart now"}
            </CommandButton>
            <button
              type="button"
              class="button"
              onClick={() => {
                sure_of.value = "";
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
