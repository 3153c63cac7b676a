import { useSignal } from "@preact/signals";
import { useId } from "preact/hooks";
import type { Player } from "./player";
import { parseTime } from "./typed_time";

interface GoToProps {
  player: Player;
  disabled: boolean;
  input: { current: HTMLInputElement | null };
}

/** A time is typed, and gone to. */
export function GoTo({ player, disabled, input }: GoToProps) {
  const typed = useSignal("");
  const problem = useSignal("");
  const id = useId();
  const go = (event: Event) => {
    event.preventDefault();
    const parsed = parseTime(typed.value, {
      at_s: player.at_s(performance.now()),
      duration_s: player.duration_s(),
      start_utime: player.start_utime() ?? 0,
    });
    problem.value = "problem" in parsed ? parsed.problem : "";
    if ("problem" in parsed) return;
    player.seek(parsed.t_s);
    typed.value = "";
    input.current?.blur();
  };
  return (
    <form class="go-to number-field" onSubmit={go}>
      <input
        ref={input}
        type="text"
        autocomplete="off"
        placeholder="Go to"
        aria-label="Go to a time"
        title='A time to go to (G): "1:30" into the recording, "+10" or "-10" from here, "14:30:05Z" by the clock'
        aria-invalid={problem.value !== ""}
        aria-describedby={problem.value === "" ? undefined : id}
        disabled={disabled}
        value={typed.value}
        onInput={(event) => {
          typed.value = event.currentTarget.value;
          problem.value = "";
        }}
        onBlur={() => {
          problem.value = "";
        }}
        onKeyDown={(event) => {
          if (event.key !== "Escape") return;
          typed.value = "";
          problem.value = "";
          event.currentTarget.blur();
        }}
      />
      {problem.value !== "" && (
        <span class="field-problem" id={id} role="alert">
          {problem.value}
        </span>
      )}
    </form>
  );
}
