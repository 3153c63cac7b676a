import { useSignal } from "@preact/signals";
import type { Alarm, AlarmList } from "../link/messages";
import { CommandButton } from "../panels/command_button";
import { Lamp } from "../panels/icons";
import { VehicleChip } from "../panels/vehicle_chip";
import type { Station } from "../shell/station";
import { missionTime } from "../units/format";
import { inChosenUnits } from "../units/station_text";
import {
  acknowledge,
  countdown,
  kEnded,
  kOver,
  kSeverityNames,
  kShelved,
  shelve,
  unshelve,
  wantsAcknowledgement,
} from "./alarm_list";
import { sendAlarm } from "./send";

interface AlarmRowProps {
  station: Station;
  list: AlarmList;
  alarm: Alarm;
}

const kShelves = [
  [60, "1 min"],
  [300, "5 min"],
  [900, "15 min"],
] as const;

/** One alarm: what, since when, whom it is about, and what can be done. */
export function AlarmRow({ station, list, alarm }: AlarmRowProps) {
  const shelving = useSignal(false);
  const { store } = station;
  const flashes = wantsAcknowledgement(alarm);
  const text = inChosenUnits(alarm.text);
  const start_utime = store.roster.value?.start_utime ?? 0;
  const send = (body: ReturnType<typeof acknowledge>) => () => sendAlarm(station, body);
  const press = (event: KeyboardEvent) => {
    // On the row itself; its buttons have their own Enter.
    if (event.key !== "Enter" || event.target !== event.currentTarget) return;
    event.preventDefault();
    if (event.currentTarget instanceof HTMLElement)
      event.currentTarget.querySelector<HTMLButtonElement>(".acknowledge")?.click();
  };
  return (
    <li
      class={`alarm severity-${alarm.severity}${flashes ? " flashes" : ""}`}
      data-alarm={alarm.id}
      data-condition={alarm.condition}
      data-state={alarm.state}
      tabIndex={0}
      onKeyDown={press}
      title={`${kSeverityNames[alarm.severity] ?? ""} ${alarm.id}: ${alarm.condition}`}
    >
      <Lamp level={alarm.severity} />
      <p class="alarm-text">{text}</p>
      <p class="alarm-state">
        <time>{missionTime(alarm.raised_utime, start_utime)}</time>{" "}
        {stateText(alarm, store.utimeAt(store.now_ms.value))}
      </p>
      <div class="alarm-actions">
        {[alarm.vehicle_id, alarm.other_vehicle_id]
          .filter((id) => id > 0)
          .map((id) => (
            <VehicleChip key={id} station={station} id={id} />
          ))}
        <span class="alarm-buttons">
          {alarm.state < kShelved && (
            <button
              type="button"
              class="button"
              aria-expanded={shelving.value}
              title="Put this alarm away for a time"
              onClick={() => {
                shelving.value = !shelving.value;
              }}
            >
              Shelve
            </button>
          )}
          {flashes && (
            <CommandButton
              class="button acknowledge"
              label={`Acknowledge: ${text} (Enter or A)`}
              command={send(acknowledge(list, alarm))}
            >
              Acknowledge
            </CommandButton>
          )}
          {alarm.state === kShelved && (
            <CommandButton label={`Unshelve: ${text}`} command={send(unshelve(list, alarm))}>
              Unshelve
            </CommandButton>
          )}
        </span>
      </div>
      {shelving.value && alarm.state < kShelved && (
        <div class="alarm-shelves" role="group" aria-label="Shelve for">
          <span>Shelve for</span>
          {kShelves.map(([duration_s, name]) => (
            <CommandButton
              key={duration_s}
              label={`Shelve for ${name}: ${text}`}
              command={send(shelve(list, alarm, duration_s))}
            >
              {name}
            </CommandButton>
          ))}
        </div>
      )}
    </li>
  );
}

function stateText(alarm: Alarm, utime: number | null): string {
  const by = alarm.acknowledged_by === "" ? "" : ` by ${alarm.acknowledged_by}`;
  const acknowledged = alarm.acknowledged_utime > 0 ? `acknowledged${by}` : "";
  if (alarm.state === kShelved) {
    const left_s = (alarm.shelved_until_utime - (utime ?? alarm.shelved_until_utime)) / 1e6;
    const who = alarm.shelved_by === "" ? "" : ` by ${alarm.shelved_by}`;
    return `${alarm.cleared_utime > 0 ? "ended, " : ""}shelved${who}, ${countdown(left_s)} left`;
  }
  if (alarm.state === kEnded) return "has ended, not acknowledged";
  if (alarm.state === kOver) return acknowledged === "" ? "over, not acknowledged" : `over, ${acknowledged}`;
  return acknowledged === "" ? "not acknowledged" : acknowledged;
}
