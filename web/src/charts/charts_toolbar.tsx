import { identityOf } from "../map/colours";
import { Popover } from "../shell/popover";
import type { Store } from "../state/store";
import { clock, utc } from "../units/format";
import { kCharts } from "./chart_list";
import { cursor_s, hidden_charts, time_window } from "./charts_state";
import { dashOf, kMostCurves } from "./curves";
import { kAll } from "./time_window";

const kWindows = [
  ["1 min", 60],
  ["5 min", 300],
  ["15 min", 900],
  ["All", Infinity],
] as const;

interface ChartsToolbarProps {
  store: Store;
  ids: readonly number[];
  /** There is nothing to export. */
  empty: boolean;
  exportCsv: () => void;
  exportPng: () => void;
}

export function ChartsToolbar({ store, ids, empty, exportCsv, exportPng }: ChartsToolbarProps) {
  const window = time_window.value;
  const last_s = "last_s" in window ? window.last_s : null;
  return (
    <div class="charts-head">
      <span class="button-row" role="group" aria-label="Time shown">
        {kWindows.map(([label, seconds]) => (
          <button
            key={label}
            type="button"
            class="button"
            aria-pressed={last_s === seconds}
            title={seconds === Infinity ? "The whole flight (0)" : `The last ${label}`}
            onClick={() => {
              time_window.value = seconds === Infinity ? kAll : { last_s: seconds };
            }}
          >
            {label}
          </button>
        ))}
      </span>
      <Legend store={store} ids={ids} />
      <CursorTime start_utime={store.roster.value?.start_utime ?? 0} />
      <Popover label="Which charts" button="Charts" class="button">
        <ul class="column-list">
          {kCharts.map(({ column, title }) => (
            <li key={column}>
              <label>
                <input
                  type="checkbox"
                  checked={!hidden_charts.value.includes(column)}
                  onChange={({ currentTarget }) => {
                    const others = hidden_charts.value.filter((other) => other !== column);
                    hidden_charts.value = currentTarget.checked ? others : [...others, column];
                  }}
                />
                {title}
              </label>
            </li>
          ))}
        </ul>
      </Popover>
      <button
        type="button"
        class="button"
        disabled={empty}
        title="The time shown as a table: SI units, UTC and T+"
        onClick={exportCsv}
      >
        CSV
      </button>
      <button
        type="button"
        class="button"
        disabled={empty}
        title="All charts as a picture"
        onClick={exportPng}
      >
        PNG
      </button>
    </div>
  );
}

/** Whose curves these are, and why theirs. */
function Legend({ store, ids }: { store: Store; ids: readonly number[] }) {
  const selected = store.selection.value.size;
  const why =
    selected === 0
      ? (store.roster.value?.vehicles.length ?? 0) > kMostCurves
        ? `The ${kMostCurves} worst:`
        : "All:"
      : selected > kMostCurves
        ? `${kMostCurves} worst of ${selected} selected:`
        : "Selected:";
  return (
    <ul class="curve-legend" aria-label="Curves">
      <li class="hint">{why}</li>
      {ids.map((id) => (
        <li key={id}>
          <svg class={`curve-swatch stroke-${identityOf(id)}`} viewBox="0 0 26 8" aria-hidden="true">
            <path d="M0 4H26" stroke-dasharray={dashOf(id).join(" ")} />
          </svg>
          {store.callsign(id)}
        </li>
      ))}
    </ul>
  );
}

function CursorTime({ start_utime }: { start_utime: number }) {
  const t_s = cursor_s.value;
  return (
    <span class="cursor-time">{t_s !== null && `T+ ${clock(t_s)}, ${utc(start_utime + t_s * 1e6)} UTC`}</span>
  );
}
