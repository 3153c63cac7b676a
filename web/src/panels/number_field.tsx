import { useSignal } from "@preact/signals";
import { useId, useRef } from "preact/hooks";
import type { Quantity } from "../units/quantities";
import { numberProblem, parseNumber } from "../units/typed_number";

interface NumberFieldProps {
  /** Accessible name; the unit is added. */
  label: string;
  /** SI, as are least and most; null: nothing is shown until something is typed. */
  value: number | null;
  /** Takes the typed number, in SI. Called only with what is within least and most. */
  commit: (si: number) => void;
  quantity: Quantity;
  least: number;
  most: number;
  decimals?: number;
  /** By how much the arrow keys change it, in the unit that is shown. */
  step?: number;
  /** What is shown for zero, and may be typed or left empty for it: "auto". */
  zero?: string;
  disabled?: boolean;
  /** What else may be wrong with a number [SI] that is within the limits; null: nothing. */
  check?: (si: number) => string | null;
}

/** A number in the unit that the person has chosen, checked where it is typed. Enter or leaving takes it, Escape takes it back. */
export function NumberField(props: NumberFieldProps) {
  const { quantity, decimals = 0, step = 1, zero } = props;
  const typed = useSignal<string | null>(null);
  const input = useRef<HTMLInputElement>(null);
  const error_id = useId();

  const limits = {
    least: quantity.value(props.least),
    most: quantity.value(props.most),
    unit: quantity.unit(),
    ...(zero === undefined ? {} : { zero }),
  };
  const shown =
    props.value === null
      ? ""
      : zero !== undefined && props.value === 0
        ? zero
        : plain(quantity.value(props.value), decimals);
  const problemOf = (text: string) =>
    numberProblem(text, limits) ?? props.check?.(quantity.toSi(parseNumber(text, zero) ?? 0)) ?? null;
  const problem = typed.value === null || typed.value === shown ? null : problemOf(typed.value);

  const take = () => {
    const text = typed.value;
    if (text === null || problem !== null) return;
    typed.value = null;
    if (text !== shown && !(props.value === null && text.trim() === "")) {
      props.commit(quantity.toSi(parseNumber(text, zero) ?? 0));
    }
  };
  const stepBy = (steps: number) => {
    const from = parseNumber(typed.value ?? shown, zero);
    if (from === null) return;
    const to = Math.min(Math.max(from + steps * step, limits.least), limits.most);
    if ((props.check?.(quantity.toSi(to)) ?? null) !== null) return;
    typed.value = null;
    props.commit(quantity.toSi(to));
  };
  const press = (event: KeyboardEvent) => {
    if (event.key === "Enter") take();
    else if (event.key === "Escape" && typed.value !== null) typed.value = null;
    else if (event.key === "ArrowUp") stepBy(event.shiftKey ? 10 : 1);
    else if (event.key === "ArrowDown") stepBy(event.shiftKey ? -10 : -1);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  return (
    <span class="number-field">
      <input
        ref={input}
        type="text"
        inputMode="decimal"
        autocomplete="off"
        aria-label={quantity.unit() === "" ? props.label : `${props.label} [${quantity.unit()}]`}
        aria-invalid={problem !== null}
        aria-describedby={problem === null ? undefined : error_id}
        title={props.label}
        value={typed.value ?? shown}
        disabled={props.disabled ?? false}
        onFocus={() => {
          input.current?.select();
        }}
        onInput={(event) => {
          typed.value = event.currentTarget.value;
        }}
        onBlur={() => {
          if (problem === null) take();
        }}
        onKeyDown={press}
      />
      {problem !== null && (
        <span class="field-problem" id={error_id} role="alert">
          {problem}
        </span>
      )}
    </span>
  );
}

/** As people type it: no more decimals than there are, no true minus sign. */
function plain(value: number, decimals: number): string {
  return String(Number(value.toFixed(decimals)));
}
