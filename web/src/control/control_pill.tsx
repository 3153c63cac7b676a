import { useSignal } from "@preact/signals";
import { useId, useLayoutEffect } from "preact/hooks";
import { CommandButton } from "../panels/command_button";
import type { PanelProps } from "../shell/panel_props";
import { Popover } from "../shell/popover";
import { useShortcuts } from "../shell/shortcuts";
import { replay } from "../state/replay";
import { person_name, view_only, type Control } from "./control";
import { holderOf, nameProblem, othersOf, youHold, youOf, type ControlMessage } from "./people";
import { TakeOver } from "./take_over";
import "./control.css";

/** Who holds control: always in sight, and what can be done about it. */
export function ControlPill({ station }: PanelProps) {
  const { control } = station;
  const state = control.state.value;
  useShortcuts([
    {
      keys: "Shift+c",
      label: "Take control, or ask for it",
      group: "Flight",
      run: () => {
        if (control.state.value !== null && !youHold(control.state.value)) void control.ask();
      },
    },
  ]);
  if (state === null || replay.value !== null || station.store.connection.value.kind !== "open") return null;
  const holder = holderOf(state);
  const you_hold = youHold(state);
  const who = you_hold
    ? "You have control"
    : holder === null
      ? "Nobody has control"
      : `${holder.name} has control`;
  return (
    <Popover
      label={`${who}. Control…`}
      class={`control-pill ${you_hold ? "yours" : holder === null ? "nobodys" : "others"}`}
      button={
        <>
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d="M8 8.500a3 3 0 1 0-.01 0M2.500 14.500c.6-3 2.800-4 5.500-4s4.900 1 5.500 4" />
          </svg>
          <span class="control-who">{you_hold ? "You" : (holder?.name ?? "Nobody")}</span>
        </>
      }
    >
      <ControlMenu control={control} state={state} now_ms={station.store.now_ms.value} />
    </Popover>
  );
}

interface MenuProps {
  control: Control;
  state: ControlMessage;
  now_ms: number;
}

function ControlMenu({ control, state, now_ms }: MenuProps) {
  const holder = holderOf(state);
  const you_hold = youHold(state);
  const since_s = (now_ms - control.arrival_ms) / 1000;
  return (
    <div class="control-menu">
      <h2>Control</h2>
      <p>
        {you_hold
          ? "You command the fleet. Everybody else looks on."
          : holder === null
            ? "Nobody commands the fleet."
            : holder.kept_for_s === null
              ? `${holder.name} commands the fleet. You are looking on.`
              : `${holder.name} is gone; control is free in ${Math.ceil(Math.max(0, holder.kept_for_s - since_s))} s.`}
      </p>
      {!state.may_operate && <p>This session may only look.</p>}
      {state.may_operate && (
        <YourChoices control={control} state={state} since_s={since_s} holder={holder?.name ?? null} />
      )}
      <Others control={control} state={state} />
      <NameForm control={control} name={youOf(state)?.name ?? ""} />
      <label class="view-only">
        <input
          type="checkbox"
          checked={view_only.value}
          onChange={(event) => {
            control.lookOnly(event.currentTarget.checked);
          }}
        />
        <span>View only: never take control by itself</span>
      </label>
    </div>
  );
}

interface ChoicesProps {
  control: Control;
  state: ControlMessage;
  since_s: number;
  holder: string | null;
}

function YourChoices({ control, state, since_s, holder }: ChoicesProps) {
  if (youHold(state)) {
    return (
      <CommandButton always label="Release control" command={() => control.release()}>
        Release
      </CommandButton>
    );
  }
  if (holder === null) {
    return (
      <CommandButton always class="button primary" label="Take control" command={() => control.take()}>
        Take control
      </CommandButton>
    );
  }
  const waits_for_s = youOf(state)?.waits_for_s ?? null;
  if (waits_for_s === null) {
    return (
      <CommandButton always class="button primary" label="Ask for control" command={() => control.ask()}>
        Ask for control
      </CommandButton>
    );
  }
  return <TakeOver control={control} holder={holder} left_s={Math.max(0, waits_for_s - since_s)} />;
}

function Others({ control, state }: { control: Control; state: ControlMessage }) {
  const others = othersOf(state);
  if (others.length === 0) return <p class="hint">Nobody else has this page open.</p>;
  return (
    <ul class="people" aria-label="Others at the page">
      {others.map(({ id, name, may_operate, waits_for_s }) => (
        <li key={id}>
          <span class="person">{name}</span>
          <span class="hint">
            {id === state.holder ? "has control" : waits_for_s !== null ? "asks for control" : "looks on"}
          </span>
          {youHold(state) && may_operate && (
            <CommandButton always label={`Hand over control to ${name}`} command={() => control.give(id)}>
              Hand over
            </CommandButton>
          )}
        </li>
      ))}
    </ul>
  );
}

/** The name by which the others know this person; remembered by the browser. */
function NameForm({ control, name }: { control: Control; name: string }) {
  const typed = useSignal(person_name.value || name);
  const refusal = useSignal("");
  const id = useId();
  // The bridge may have found another one, because two had the same.
  useLayoutEffect(() => {
    typed.value = name;
  }, [typed, name]);
  const problem = nameProblem(typed.value) || refusal.value;
  const save = (event: Event) => {
    event.preventDefault();
    if (nameProblem(typed.value) !== "") return;
    void control.rename(typed.value.trim()).then(({ accepted, reason }) => {
      refusal.value = accepted ? "" : reason;
    });
  };
  return (
    <form class="name-form" onSubmit={save}>
      <label for={id}>Your name</label>
      <input
        id={id}
        type="text"
        autocomplete="off"
        value={typed.value}
        aria-invalid={problem !== ""}
        aria-describedby={`${id}-problem`}
        onInput={(event) => {
          typed.value = event.currentTarget.value;
          refusal.value = "";
        }}
      />
      <button type="submit" class="button" disabled={problem !== "" || typed.value.trim() === name}>
        Save
      </button>
      <p id={`${id}-problem`} class="problem" role="status">
        {problem}
      </p>
    </form>
  );
}
