import { NumberField } from "../panels/number_field";
import { altitude, distance, inUnit } from "../units/quantities";
import { withGain, withPresets, type Limits } from "./draft";
import { kControlNames, kControls, kGains } from "./gains";
import type { EditSession } from "./session";

const kSeconds = inUnit("s");
/** No gain that makes sense is larger. */
const kMostGain = 1e6;

const kLimitFields = [
  ["radius_m", "R, radius of the cylinder", "R", distance, 1, 100_000],
  ["height_m", "H, half the height of the cylinder", "H", altitude, 1, 100_000],
  ["d_mod_m", "D_mod of Tau, at least R", "D_mod", distance, 1, 100_000],
  ["advisory_tau_s", "Tau of an advisory", "Tau advisory", kSeconds, 1, 10_000],
  ["caution_tau_s", "Tau of a caution", "Tau caution", kSeconds, 1, 10_000],
] as const satisfies readonly (readonly [keyof Limits, ...unknown[]])[];

/** The cylinder that members keep to one another, and when they are warned. */
export function LimitsForm({ session }: { session: EditSession }) {
  const draft = session.draft.value;
  return (
    <details class="part">
      <summary>
        Cylinder and thresholds
        <span class="summary-value">
          R {distance.full(draft.limits.radius_m)}, H {altitude.full(draft.limits.height_m)}
        </span>
      </summary>
      <div class="formation-fields">
        {kLimitFields.map(([name, label, short, quantity, least, most]) => (
          <label class="formation-field" key={name} title={label}>
            <span aria-hidden="true">
              {short} [{quantity.unit()}]
            </span>
            <NumberField
              label={label}
              value={draft.limits[name]}
              quantity={quantity}
              least={least}
              most={most}
              step={name.endsWith("_s") ? 1 : 10}
              commit={(value) => {
                const limits = { ...draft.limits, [name]: value };
                // A wider cylinder alone takes D_mod along.
                if (name === "radius_m") limits.d_mod_m = Math.max(value, limits.d_mod_m);
                session.change({ ...draft, limits }, short);
              }}
            />
          </label>
        ))}
      </div>
    </details>
  );
}

/** Which law flies the formation, with its gains. */
export function LawForm({ session }: { session: EditSession }) {
  const draft = session.draft.value;
  const overrides = draft.gains[draft.control];
  const count = Object.keys(overrides).length;
  return (
    <details class="part">
      <summary>
        Control law
        <span class="summary-value">
          {draft.control}, {count === 0 ? "presets" : `${count} ${count === 1 ? "gain" : "gains"} changed`}
        </span>
      </summary>
      <div class="law-head">
        <select
          aria-label="Control law"
          value={draft.control}
          onChange={(event) => {
            const control = kControls.find((one) => one === event.currentTarget.value) ?? draft.control;
            session.change({ ...draft, control }, `control ${control}`);
          }}
        >
          {kControls.map((control) => (
            <option key={control} value={control}>
              {kControlNames[control]}
            </option>
          ))}
        </select>
        <button
          type="button"
          class="button"
          disabled={count === 0}
          title="All gains of this law as they are preset"
          onClick={() => {
            session.change(withPresets(draft), "presets");
          }}
        >
          Presets
        </button>
      </div>
      <table class="gains" aria-label={`Gains of control ${draft.control}`}>
        <thead>
          <tr>
            <th scope="col">Gain</th>
            <th scope="col" class="value">
              Preset
            </th>
            <th scope="col" class="value">
              Value
            </th>
            <th scope="col">
              <span class="visually-hidden">Reset</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {kGains[draft.control].map((gain) => {
            const changed = gain.name in overrides;
            return (
              <tr key={gain.name} class={changed ? "changed" : ""}>
                <th scope="row" title={gain.name}>
                  {gain.label} {gain.unit !== "" && <span class="unit">{gain.unit}</span>}
                </th>
                <td class="value preset">{gain.preset}</td>
                <td class="value">
                  <NumberField
                    label={gain.label}
                    value={overrides[gain.name] ?? gain.preset}
                    quantity={inUnit(gain.unit)}
                    least={gain.least}
                    most={Math.min(gain.most, kMostGain)}
                    decimals={6}
                    step={gain.preset / 10}
                    commit={(value) => {
                      session.change(withGain(draft, gain.name, value), gain.label.toLowerCase());
                    }}
                  />
                </td>
                <td>
                  <button
                    type="button"
                    class="button quiet"
                    disabled={!changed}
                    aria-label={`Preset of ${gain.label}`}
                    title={`Back to ${gain.preset}`}
                    onClick={() => {
                      session.change(withGain(draft, gain.name, gain.preset), `preset of ${gain.label}`);
                    }}
                  >
                    ↺
                  </button>
                </td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </details>
  );
}
