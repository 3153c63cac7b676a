import { useSignal, type Signal } from "@preact/signals";
import { Fragment } from "preact";
import type { BusEvent } from "../link/messages";
import { Lamp } from "../panels/icons";
import { VehicleChip } from "../panels/vehicle_chip";
import type { PanelProps } from "../shell/panel_props";
import type { Station } from "../shell/station";
import { missionTime, utc } from "../units/format";
import { inChosenUnits } from "../units/station_text";
import "./events.css";
import { filterEvents } from "./filter";
import { flightStarts, startBetween } from "./flights";

/** So many rows are drawn at first, and with each press on "Show more". */
const kPage = 100;

/** What the nodes reported, newest first. */
export function EventList({ station }: PanelProps) {
  const { store } = station;
  const text = useSignal("");
  const least_severity = useSignal(0);
  const only_selected = useSignal(false);
  const most = useSignal(kPage);
  const events = store.events.value;
  const found = filterEvents(
    events,
    {
      text: text.value,
      least_severity: least_severity.value,
      ids: only_selected.value ? store.selection.value : null,
    },
    (id) => store.callsign(id),
  );
  const starts = flightStarts(events, store.roster.value?.start_utime ?? 0);
  const startAfter = (i: number) => {
    const [event, older] = [found[i], found[i + 1]];
    return event === undefined || older === undefined ? null : startBetween(starts, event, older);
  };
  return (
    <section class="events" aria-label="Events">
      <Filters text={text} least_severity={least_severity} only_selected={only_selected} />
      {found.length === 0 ? (
        <p class="empty">
          {events.length === 0
            ? "Nothing has been reported."
            : only_selected.value && store.selection.value.size === 0
              ? "No UAV is selected: select some in the table or on the map, or show all."
              : "No event is like that: take another word or a lower severity."}
        </p>
      ) : (
        // Scrolls, so it must be reachable by keyboard.
        <ol tabIndex={0} aria-label={`Events, newest first: ${found.length} of ${events.length}`}>
          {found.slice(0, most.value).map((event, i) => (
            <Fragment key={`${event.event_node}/${event.utime}/${event.event_sequence}`}>
              <EventRow station={station} event={event} />
              <FlightStart utime={startAfter(i)} />
            </Fragment>
          ))}
          {found.length > most.value && (
            <li class="more">
              <button
                type="button"
                class="button"
                onClick={() => {
                  most.value += kPage;
                }}
              >
                Show more ({found.length - most.value} are older)
              </button>
            </li>
          )}
        </ol>
      )}
    </section>
  );
}

interface FiltersProps {
  text: Signal<string>;
  least_severity: Signal<number>;
  only_selected: Signal<boolean>;
}

const kSeverities = ["All", "Advisory and worse", "Caution and worse", "Warnings"] as const;

function Filters({ text, least_severity, only_selected }: FiltersProps) {
  return (
    <div class="event-filters" role="search" aria-label="Events">
      <input
        type="search"
        class="field"
        placeholder="Search"
        aria-label="Search events"
        value={text.value}
        onInput={(event) => {
          text.value = event.currentTarget.value;
        }}
      />
      <select
        class="field"
        aria-label="Severity"
        value={String(least_severity.value)}
        onChange={(event) => {
          least_severity.value = Number(event.currentTarget.value);
        }}
      >
        {kSeverities.map((name, severity) => (
          <option key={name} value={severity}>
            {name}
          </option>
        ))}
      </select>
      <label class="check" title="Only events of the UAVs that are selected">
        <input
          type="checkbox"
          checked={only_selected.value}
          onChange={(event) => {
            only_selected.value = event.currentTarget.checked;
          }}
        />
        Selected UAVs
      </label>
    </div>
  );
}

/** Between the events of two flights: above it is the later one. */
function FlightStart({ utime }: { utime: number | null }) {
  if (utime === null) return null;
  return <li class="flight-start">New flight, {utc(utime)} UTC</li>;
}

function EventRow({ station, event }: { station: Station; event: BusEvent }) {
  const start_utime = station.store.roster.value?.start_utime ?? 0;
  return (
    <li title={`${event.event_node}: ${event.code}, ${utc(event.utime)} UTC`}>
      <Lamp level={event.severity} />
      <time>{missionTime(event.utime, start_utime)}</time>
      <span>{inChosenUnits(event.text)}</span>
      {event.vehicle_id > 0 && <VehicleChip station={station} id={event.vehicle_id} />}
    </li>
  );
}
