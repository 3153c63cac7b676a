/** Which of the events a person wants to see. */
import type { BusEvent } from "../link/messages";

export interface EventFilter {
  /** Words that must all be found in text, code, node or callsign, whatever the case. */
  text: string;
  /** 0 info, 1 advisory, 2 caution, 3 warning. */
  least_severity: number;
  /** Only what is about these UAVs; null: all. */
  ids: ReadonlySet<number> | null;
}

export function filterEvents(
  events: readonly BusEvent[],
  filter: EventFilter,
  callsign: (id: number) => string,
): readonly BusEvent[] {
  const words = filter.text.toLowerCase().split(/\s+/).filter(Boolean);
  return events.filter((event) => {
    if (event.severity < filter.least_severity) return false;
    if (filter.ids !== null && !filter.ids.has(event.vehicle_id)) return false;
    if (words.length === 0) return true;
    const name = event.vehicle_id > 0 ? callsign(event.vehicle_id) : "";
    const text = `${event.text} ${event.code} ${event.event_node} ${name}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
}
