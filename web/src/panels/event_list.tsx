import type { BusEvent } from "../link/messages";
import type { PanelProps } from "../shell/panel_list";
import type { Store } from "../state/store";
import { clock, utc } from "../units/format";
import { Lamp } from "./icons";

const kShown = 60;

/** What the nodes reported, newest first. */
export function EventList({ station }: PanelProps) {
  const { store } = station;
  const events = store.events.value.slice(0, kShown);
  return (
    <section class="events" aria-label="Events">
      {events.length === 0 ? (
        <p class="empty">Nothing has been reported.</p>
      ) : (
        // Scrolls, so it must be reachable by keyboard.
        <ol tabIndex={0} aria-label="Events, newest first">
          {events.map((event) => (
            <EventRow
              key={`${event.event_node}/${event.utime}/${event.event_sequence}`}
              store={store}
              event={event}
            />
          ))}
        </ol>
      )}
    </section>
  );
}

function EventRow({ store, event }: { store: Store; event: BusEvent }) {
  const start_utime = store.roster.value?.start_utime ?? 0;
  // Events of an earlier flight have no time in this one.
  const time =
    start_utime > 0 && event.utime >= start_utime
      ? `T+ ${clock((event.utime - start_utime) / 1e6)}`
      : utc(event.utime);
  return (
    <li title={`${event.event_node}: ${event.code}, ${utc(event.utime)} UTC`}>
      <Lamp level={event.severity} />
      <time>{time}</time>
      <span>{event.text}</span>
    </li>
  );
}
