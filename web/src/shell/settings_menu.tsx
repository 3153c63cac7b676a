import type { Signal } from "@preact/signals";
import { altitude_unit, distance_unit, speed_unit, theme_choice } from "../state/settings";
import type { Session } from "../sign_in/session";
import { SignedIn } from "../sign_in/sign_in";
import { Icon } from "./icon";
import { Popover } from "./popover";

/** What a person chooses for this browser. */
export function SettingsMenu({ session }: { session: Session }) {
  return (
    <Popover label="Settings" button={<Icon name="settings" />}>
      <h2>Appearance</h2>
      <Choice
        label="Theme"
        value={theme_choice}
        choices={[
          ["system", "Auto"],
          ["light", "Light"],
          ["dark", "Dark"],
        ]}
      />
      <h2>Units</h2>
      <Choice
        label="Altitude"
        value={altitude_unit}
        choices={[
          ["m", "m"],
          ["ft", "ft"],
        ]}
      />
      <Choice
        label="Distance"
        value={distance_unit}
        choices={[
          ["m", "m"],
          ["ft", "ft"],
        ]}
      />
      <Choice
        label="Speed"
        value={speed_unit}
        choices={[
          ["m/s", "m/s"],
          ["km/h", "km/h"],
          ["kt", "kt"],
        ]}
      />
      <SignedIn session={session} />
      <p class="hint">Altitudes are above the local origin (ENU). Courses are compass degrees.</p>
    </Popover>
  );
}

interface ChoiceProps<T extends string> {
  label: string;
  value: Signal<T>;
  choices: readonly (readonly [T, string])[];
}

/** One of a few, all in sight. */
export function Choice<T extends string>({ label, value, choices }: ChoiceProps<T>) {
  return (
    <div class="choice">
      <span aria-hidden="true">{label}</span>
      <div class="segments" role="radiogroup" aria-label={label}>
        {choices.map(([choice, name]) => (
          <label key={choice}>
            <input
              type="radio"
              name={label}
              value={choice}
              checked={value.value === choice}
              onChange={() => {
                value.value = choice;
              }}
            />
            <span>{name}</span>
          </label>
        ))}
      </div>
    </div>
  );
}
