import { useSignal } from "@preact/signals";
import { CommandButton } from "../panels/command_button";
import type { Control } from "./control";

interface TakeOverProps {
  control: Control;
  holder: string;
  /** How long the holder may still answer [s]. */
  left_s: number;
}

/** For who has asked: waits for the answer; when none has come, takes control over, but only after a second look. */
export function TakeOver({ control, holder, left_s }: TakeOverProps) {
  const sure = useSignal(false);
  if (left_s > 0) {
    return (
      <div class="asked" role="status">
        <span>
          Asked. {holder} has {Math.ceil(left_s)} s to answer.
        </span>
        <CommandButton always label="Take back the request" command={() => control.withdraw()}>
          Take back
        </CommandButton>
      </div>
    );
  }
  return (
    <div class="asked">
      <span role="status">
        {sure.value ? `Take control away from ${holder}?` : `${holder} has not answered.`}
      </span>
      {sure.value ? (
        <CommandButton
          always
          class="button primary"
          label={`Yes, take over from ${holder}`}
          command={() => control.take()}
        >
          Yes, take over
        </CommandButton>
      ) : (
        <button
          type="button"
          class="button"
          onClick={() => {
            sure.value = true;
          }}
        >
          Take over…
        </button>
      )}
      <CommandButton always label="Cancel the request" command={() => control.withdraw()}>
        Cancel
      </CommandButton>
    </div>
  );
}
