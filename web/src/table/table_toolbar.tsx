import { useSignal } from "@preact/signals";
import { useId } from "preact/hooks";
import { CommandButton } from "../panels/command_button";
import { Popover } from "../shell/popover";
import type { Station } from "../shell/station";
import { kColumns } from "./columns";
import { parseIdRange } from "./id_range";
import { inForce, kWorstFirst, type Show } from "./row_order";
import { Summary } from "./summary";
import { filter_text, hidden_columns, order, show } from "./table_settings";

interface TableToolbarProps {
  station: Station;
  shown: readonly number[];
  /** The order is no longer what it would be, because somebody is at it. */
  held: boolean;
}

/** Above the table: how the fleet is, what is shown of it, who is selected and what can be done with them. */
export function TableToolbar({ station, shown, held }: TableToolbarProps) {
  const { store } = station;
  const total = store.roster.value?.vehicles.length ?? 0;
  return (
    <div class="table-head">
      <Summary store={store} />
      <Filter station={station} />
      {shown.length < total && (
        <span class="hint">
          {shown.length} of {total} shown
        </span>
      )}
      <SortChoice />
      {held && (
        <span
          class="hint"
          title="Rows stay where they are while somebody is at the table: until 15 s after the last move or key"
        >
          Order held
        </span>
      )}
      <span class="spring" />
      <RangeField station={station} />
      <Selection station={station} />
      <ColumnChoice />
    </div>
  );
}

function Filter({ station }: { station: Station }) {
  const formations = [...station.store.formations.value.values()].sort(
    (a, b) => a.formation_id - b.formation_id,
  );
  return (
    <>
      <select
        class="field"
        aria-label="Show"
        title="Which UAVs the table shows"
        value={String(inForce(show.value, station.store.formations.value))}
        onChange={({ currentTarget }) => {
          const { value } = currentTarget;
          show.value = /^\d+$/.test(value) ? Number(value) : (value as Show);
        }}
      >
        <option value="all">All</option>
        <option value="alerting">Alerting</option>
        <option value="lost">Link lost</option>
        {formations.map(({ formation_id, name }) => (
          <option key={formation_id} value={String(formation_id)}>
            {name === "" ? `Formation ${formation_id}` : name}
          </option>
        ))}
      </select>
      <input
        class="field find"
        type="search"
        placeholder="Find"
        aria-label="Find by callsign, id, model or formation"
        title="Find by callsign, id, model or formation"
        value={filter_text.value}
        onInput={({ currentTarget }) => (filter_text.value = currentTarget.value)}
      />
    </>
  );
}

function SortChoice() {
  const { key } = order.value;
  return (
    <select
      class="field"
      aria-label="Order"
      title="Worst first: by level, then link, then error from the slot. Column heads sort, too"
      value={key}
      onChange={({ currentTarget }) => {
        order.value = currentTarget.value === "id" ? { key: "id", reversed: false } : kWorstFirst;
      }}
    >
      <option value="worst">Worst first</option>
      <option value="id">By id</option>
      {key !== "worst" && key !== "id" && <option value={key}>By column</option>}
    </select>
  );
}

function RangeField({ station: { store } }: { station: Station }) {
  const text = useSignal("");
  const problem = useSignal("");
  const problem_id = useId();
  const select = () => {
    const known = new Set(store.roster.value?.vehicles.map(({ id }) => id));
    const range = parseIdRange(text.value, known);
    problem.value = "problem" in range ? range.problem : "";
    if ("ids" in range) store.select(range.ids);
  };
  return (
    <form
      class="range"
      onSubmit={(event) => {
        event.preventDefault();
        select();
      }}
    >
      <input
        class="field"
        type="text"
        placeholder="Select ids: 1-20, 35"
        aria-label="Select ids, such as 1-20, 35"
        title="Ids and ranges of ids, then Enter"
        aria-invalid={problem.value !== ""}
        aria-describedby={problem.value === "" ? undefined : problem_id}
        value={text.value}
        onInput={({ currentTarget }) => {
          text.value = currentTarget.value;
          problem.value = "";
        }}
      />
      {problem.value !== "" && (
        <span class="problem" id={problem_id} role="alert">
          {problem.value}
        </span>
      )}
    </form>
  );
}

/** How many are selected, and their payloads. */
function Selection({ station }: { station: Station }) {
  const { store, payloads } = station;
  const selection = store.selection.value;
  const carriers = (store.roster.value?.vehicles ?? []).filter(
    ({ id, has_payload }) => has_payload && selection.has(id),
  );
  const ids = carriers.map(({ id }) => id);
  return (
    <span class="selection">
      <span class="selected-count">
        {selection.size === 0 ? "None selected" : `${selection.size} selected`}
      </span>
      <span class="button-pair" role="group" aria-label="Payload of the selected">
        <CommandButton
          label={`Payload on: ${ids.length} of the selected carry one`}
          disabled={ids.length === 0}
          command={() => payloads.request(ids, true)}
        >
          Payload on
        </CommandButton>
        <CommandButton
          label={`Payload off: ${ids.length} of the selected carry one`}
          disabled={ids.length === 0}
          command={() => payloads.request(ids, false)}
        >
          Off
        </CommandButton>
      </span>
      <button
        type="button"
        class="button"
        disabled={selection.size === 0}
        title="Select none (Esc in the table)"
        onClick={() => {
          store.select([]);
        }}
      >
        Clear
      </button>
    </span>
  );
}

function ColumnChoice() {
  const hidden = hidden_columns.value;
  return (
    <Popover label="Columns" button="Columns" class="button">
      <ul class="column-list">
        {kColumns
          .filter(({ id }) => id !== "uav")
          .map(({ id, name }) => (
            <li key={id}>
              <label>
                <input
                  type="checkbox"
                  checked={!hidden.includes(id)}
                  onChange={({ currentTarget }) => {
                    hidden_columns.value = currentTarget.checked
                      ? hidden.filter((other) => other !== id)
                      : [...hidden, id];
                  }}
                />
                {name}
              </label>
            </li>
          ))}
      </ul>
    </Popover>
  );
}
