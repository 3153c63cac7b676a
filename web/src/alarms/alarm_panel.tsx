import { useRef } from "preact/hooks";
import type { Alarm, AlarmList } from "../link/messages";
import { CommandButton } from "../panels/command_button";
import type { PanelProps } from "../shell/panel_props";
import type { Station } from "../shell/station";
import { nothingIsOpen, replay } from "../state/replay";
import { acknowledgeAll, groupsOf } from "./alarm_list";
import { AlarmRow } from "./alarm_row";
import { sendAlarm } from "./send";
import { whyNoAlarms } from "./service";

/** What must be looked after, what is shelved, and what is over. */
export function AlarmPanel({ station }: PanelProps) {
  const { store } = station;
  const list = store.alarms.value;
  const { open, shelved, over } = groupsOf(list);
  const trouble = whyNoAlarms(store, store.now_ms.value);
  const unacknowledged =
    (list?.num_unacknowledged_warnings ?? 0) +
    (list?.num_unacknowledged_cautions ?? 0) +
    (list?.num_unacknowledged_advisories ?? 0);
  const not_listed = list?.num_not_listed ?? 0;
  return (
    <section class="alarms" aria-label="Alarms">
      <header class="alarms-head">
        <p>{open.length === 0 ? "" : `${unacknowledged} of ${open.length + not_listed} not acknowledged`}</p>
        {list !== null && (
          <CommandButton
            class="button acknowledge-all"
            label={
              not_listed === 0
                ? "Acknowledge all (Shift+A)"
                : `Acknowledge all, and the ${not_listed} that are not listed (Shift+A)`
            }
            disabled={unacknowledged === 0}
            command={() => sendAlarm(station, acknowledgeAll(list))}
          >
            Acknowledge all
          </CommandButton>
        )}
      </header>
      <div class="alarms-lists">
        {trouble !== "" && <p class="alarms-trouble">{trouble}</p>}
        {trouble === "" && open.length === 0 && (
          <p class="empty">
            {nothingIsOpen(replay.value)
              ? "Open a recording to see its alarms."
              : shelved.length === 0
                ? "Nothing is wrong: no alarm is on."
                : "No alarm is on beside what is shelved."}
          </p>
        )}
        {list !== null && (
          <>
            <Rows station={station} list={list} alarms={open} label="Alarms, the most urgent first" />
            {list.num_not_listed > 0 && <p class="empty">And {list.num_not_listed} less urgent ones.</p>}
            <Group station={station} list={list} alarms={shelved} title="Shelved" open />
            <Group station={station} list={list} alarms={over} title="History" />
          </>
        )}
      </div>
    </section>
  );
}

interface RowsProps {
  station: Station;
  list: AlarmList;
  alarms: readonly Alarm[];
  label: string;
}

/** Up and down go from alarm to alarm. */
function Rows({ station, list, alarms, label }: RowsProps) {
  const rows = useRef<HTMLOListElement>(null);
  if (alarms.length === 0) return null;
  const press = (event: KeyboardEvent) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step === undefined || rows.current === null) return;
    event.preventDefault();
    const items = [...rows.current.querySelectorAll<HTMLElement>(":scope > li")];
    const at = items.findIndex((item) => item.contains(document.activeElement));
    items[Math.min(Math.max(at + step, 0), items.length - 1)]?.focus();
  };
  return (
    <ol aria-label={label} ref={rows} onKeyDown={press}>
      {alarms.map((alarm) => (
        <AlarmRow key={alarm.id} station={station} list={list} alarm={alarm} />
      ))}
    </ol>
  );
}

interface GroupProps extends Omit<RowsProps, "label"> {
  title: string;
  open?: boolean;
}

function Group({ title, open = false, ...rows }: GroupProps) {
  if (rows.alarms.length === 0) return null;
  return (
    <details open={open} class="alarms-group">
      <summary>
        {title} <span class="count">{rows.alarms.length}</span>
      </summary>
      <Rows {...rows} label={title} />
    </details>
  );
}
