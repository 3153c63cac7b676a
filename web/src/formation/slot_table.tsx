import { useSignal } from "@preact/signals";
import { identityOf } from "../map/colours";
import { NumberField } from "../panels/number_field";
import { altitude, distance, type Quantity } from "../units/quantities";
import { kNone } from "../units/format";
import { moved, swapped, withoutMember, type Draft } from "./draft";
import type { FormationEditor, Ground } from "./editor";
import type { EditSession } from "./session";
import type { Offset } from "./shapes";

const kRow_px = 34;
/** Rows that are drawn beyond what is seen, so that scrolling shows no gaps. */
const kSpare = 6;
const kShown = 7;
const kFarthest_m = 200_000;
const kHighest_m = 20_000;

const kAxes = [
  ["forward_m", "Forward", distance, kFarthest_m],
  ["left_m", "Left", distance, kFarthest_m],
  ["up_m", "Up", altitude, kHighest_m],
] as const satisfies readonly (readonly [keyof Offset, string, Quantity, number])[];

interface SlotTableProps {
  editor: FormationEditor;
  session: EditSession;
}

/** Every slot with who flies there, foremost first. Only the rows in sight are drawn: a thousand are as quick as ten. */
export function SlotTable({ editor, session }: SlotTableProps) {
  const { store } = editor.station;
  const first = useSignal(0);
  const draft = session.draft.value;
  const now_ms = store.now_ms.value;
  const ground = editor.ground(now_ms);
  const { slots } = draft;
  const from = Math.max(0, Math.min(first.value, slots.length - kShown) - kSpare);
  const shown = slots.slice(from, from + kShown + 2 * kSpare);
  const alone = store.selection.value.size === 1;
  const after = slots.length - from - shown.length;
  return (
    <div
      class="slot-table"
      style={{ maxHeight: `${(kShown + 0.9) * kRow_px}px` }}
      onScroll={(event) => {
        first.value = Math.floor(event.currentTarget.scrollTop / kRow_px);
      }}
    >
      <table aria-label="Slots" aria-rowcount={slots.length + 1}>
        <thead>
          <tr>
            <th scope="col">UAV</th>
            {kAxes.map(([axis, name, quantity]) => (
              <th scope="col" key={axis} class="value">
                {name} <span class="unit">{quantity.unit()}</span>
              </th>
            ))}
            <th scope="col" class="value" title="How far the UAV is from its slot now">
              Way <span class="unit">{distance.unit()}</span>
            </th>
            <th scope="col">
              <span class="visually-hidden">Take out</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {from > 0 && <Gap rows={from} />}
          {shown.map((slot, i) => (
            <SlotRow
              key={slot.vehicle_id}
              index={from + i}
              conflict={editor.conflicting.value.has(slot.vehicle_id)}
              {...{ editor, session, draft, slot, alone, ground, now_ms }}
            />
          ))}
          {after > 0 && <Gap rows={after} />}
        </tbody>
      </table>
    </div>
  );
}

function Gap({ rows }: { rows: number }) {
  return (
    <tr aria-hidden="true" style={{ height: `${rows * kRow_px}px` }}>
      <td colSpan={6} />
    </tr>
  );
}

interface SlotRowProps extends SlotTableProps {
  draft: Draft;
  slot: Draft["slots"][number];
  index: number;
  /** In another one's cylinder. */
  conflict: boolean;
  /** One UAV alone is selected, and can exchange its place. */
  alone: boolean;
  ground: Ground | null;
  now_ms: number;
}

function SlotRow({ editor, session, draft, slot, index, conflict, alone, ground, now_ms }: SlotRowProps) {
  const { store } = editor.station;
  const id = slot.vehicle_id;
  const callsign = store.callsign(id);
  const selected = store.selection.value.has(id);
  const flying = editor.flying(id, now_ms);
  const place = ground?.place(slot);
  const way_m =
    flying === null || place === undefined
      ? null
      : Math.hypot(flying.east_m - place.east_m, flying.north_m - place.north_m, flying.up_m - place.up_m);
  return (
    <tr class={`${selected ? "selected" : ""} ${conflict ? "conflict" : ""}`} aria-rowindex={index + 2}>
      <th scope="row">
        {selected && alone ? (
          <Occupant {...{ editor, session, draft, id }} />
        ) : (
          <button
            type="button"
            class="slot-uav"
            title={`Select ${callsign}`}
            onClick={() => {
              store.select([id]);
            }}
          >
            <Chip id={id} />
            <span>{callsign}</span>
          </button>
        )}
      </th>
      {kAxes.map(([axis, name, quantity, most]) => (
        <td key={axis} class="value">
          <NumberField
            label={`${name} of ${callsign}`}
            value={slot[axis]}
            quantity={quantity}
            least={-most}
            most={most}
            step={10}
            commit={(metres) => {
              const by = { forward_m: 0, left_m: 0, up_m: 0, [axis]: metres - slot[axis] };
              session.change(
                moved(draft, new Set([id]), by),
                `${axis === "up_m" ? "height" : "place"} of ${callsign}`,
              );
            }}
          />
        </td>
      ))}
      <td class="value">{way_m === null ? kNone : distance.text(way_m)}</td>
      <td>
        <button
          type="button"
          class="button quiet"
          aria-label={`Take ${callsign} out of the formation`}
          title={`Take ${callsign} out of the formation`}
          onClick={() => {
            editor.reshape(withoutMember(draft, id), `take ${callsign} out`);
          }}
        >
          ✕
        </button>
      </td>
    </tr>
  );
}

/** Who flies in this slot; another one exchanges with this one. */
function Occupant({ editor, session, draft, id }: SlotTableProps & { draft: Draft; id: number }) {
  const { store } = editor.station;
  return (
    <span class="occupant">
      <Chip id={id} />
      <select
        aria-label={`Who flies in the slot of ${store.callsign(id)}`}
        title="Another UAV exchanges its slot with this one"
        value={String(id)}
        onChange={(event) => {
          const other = Number(event.currentTarget.value);
          session.change(
            swapped(draft, id, other),
            `exchange ${store.callsign(id)} and ${store.callsign(other)}`,
          );
          store.select([other]);
        }}
      >
        {draft.slots.map(({ vehicle_id }) => (
          <option key={vehicle_id} value={String(vehicle_id)}>
            {store.callsign(vehicle_id)}
          </option>
        ))}
      </select>
    </span>
  );
}

function Chip({ id }: { id: number }) {
  return <span class={`chip identity-${identityOf(id)}`}>{id}</span>;
}
