import { useSignal } from "@preact/signals";
import { NumberField } from "../panels/number_field";
import { distance } from "../units/quantities";
import { fitted, toPixel } from "./canvas_view";
import { withLead, withShape, withSpacing } from "./draft";
import type { FormationEditor } from "./editor";
import type { EditSession } from "./session";
import { kShapeNames, kShapes, shapeSlots, type Shape } from "./shapes";

interface FormProps {
  editor: FormationEditor;
  session: EditSession;
}

const kIcon_px = 28;
const kIconSlots: Readonly<Record<Shape, number>> = {
  triangle: 6,
  column: 4,
  line_abreast: 4,
  echelon_left: 4,
  echelon_right: 4,
  diamond: 4,
  vee: 5,
};

/** Keeps what is being typed, whatever else changes the draft meanwhile. Enter or leaving takes it, Escape takes it back. */
function NameField({ value, commit }: { value: string; commit: (name: string) => void }) {
  const typed = useSignal<string | null>(null);
  const take = () => {
    const name = typed.value?.trim() ?? value;
    typed.value = null;
    if (name !== value) commit(name);
  };
  return (
    <input
      type="text"
      aria-label="Name"
      maxLength={40}
      value={typed.value ?? value}
      onInput={(event) => {
        typed.value = event.currentTarget.value;
      }}
      onBlur={take}
      onKeyDown={(event) => {
        if (event.key === "Enter") take();
        else if (event.key === "Escape" && typed.value !== null) typed.value = null;
        else return;
        event.preventDefault();
        event.stopPropagation();
      }}
    />
  );
}

export function ShapeForm({ editor, session }: FormProps) {
  const draft = session.draft.value;
  const custom = draft.shape === "custom";
  return (
    <section aria-label="Shape">
      <div class="shapes" role="radiogroup" aria-label="Shape">
        {[...kShapes, "custom" as const].map((shape) => (
          <label key={shape} title={kShapeNames[shape]}>
            <input
              type="radio"
              name="shape"
              value={shape}
              aria-label={kShapeNames[shape]}
              checked={draft.shape === shape}
              onChange={() => {
                const next = withShape(draft, shape);
                const label = `shape ${kShapeNames[shape].toLowerCase()}`;
                if (shape === "custom") editor.change(next, label);
                else editor.reshape(next, label);
              }}
            />
            <ShapeIcon shape={shape} />
          </label>
        ))}
      </div>
      <div class="formation-fields">
        <label class="formation-field name">
          <span aria-hidden="true">Name</span>
          <NameField
            key={draft.formation_id}
            value={draft.name}
            commit={(name) => {
              editor.change({ ...draft, name }, "name");
            }}
          />
        </label>
        <label class="formation-field">
          <span aria-hidden="true">Spacing [{distance.unit()}]</span>
          <NumberField
            label={custom ? "Spacing: a custom formation has none, move its slots" : "Spacing"}
            value={custom ? null : draft.spacing_m}
            quantity={distance}
            least={1}
            most={100_000}
            step={50}
            disabled={custom}
            commit={(spacing_m) => {
              editor.reshape(withSpacing(draft, spacing_m), "spacing");
            }}
          />
        </label>
        <label class="formation-field">
          <span aria-hidden="true">Lead [{distance.unit()}]</span>
          <NumberField
            label="How far ahead of the first slot the virtual leader flies"
            value={draft.lead_m}
            quantity={distance}
            least={0}
            most={100_000}
            step={50}
            commit={(lead_m) => {
              editor.change(withLead(draft, lead_m), "lead");
            }}
          />
        </label>
      </div>
    </section>
  );
}

/** The shape's own slots, small. */
function ShapeIcon({ shape }: { shape: Shape | "custom" }) {
  const slots =
    shape === "custom"
      ? [
          { forward_m: 0, left_m: 60 },
          { forward_m: -40, left_m: -50 },
          { forward_m: -120, left_m: 30 },
          { forward_m: -150, left_m: -80 },
        ]
      : shapeSlots(shape, kIconSlots[shape], 100, 0);
  const view = { ...fitted(slots, 0, kIcon_px, kIcon_px), px_per_m: 0 };
  const reach = (values: number[]) => Math.max(...values) - Math.min(...values);
  view.px_per_m =
    (kIcon_px - 8) /
    Math.max(reach(slots.map((slot) => slot.forward_m)), reach(slots.map((slot) => slot.left_m)));
  return (
    <svg viewBox={`0 0 ${kIcon_px} ${kIcon_px}`} aria-hidden="true">
      {slots.map((slot, i) => {
        const { x, y } = toPixel(view, slot);
        return <circle key={i} cx={x} cy={y} r="2.6" />;
      })}
    </svg>
  );
}
