import type { Station } from "../shell/station";
import { clockTenths } from "./time_text";

/** Between A and B, over and over. */
export function LoopEnds({ station: { player, store }, disabled }: { station: Station; disabled: boolean }) {
  const loop = store.playback.value?.loop ?? null;
  const a_s = loop?.[0] ?? player.loop_a_s.value;
  const b_s = loop?.[1] ?? null;
  const end = (name: "a" | "b", at_s: number | null, key: string) => {
    const label = name === "a" ? "The loop begins here" : "The loop ends here";
    return (
      <button
        type="button"
        class="button"
        aria-label={`${name.toUpperCase()}: ${label.toLowerCase()}${at_s === null ? "" : `, now ${clockTenths(at_s)}`}`}
        aria-pressed={at_s !== null}
        title={`${label} (${key})${at_s === null ? "" : `: ${clockTenths(at_s)}`}`}
        disabled={disabled}
        onMouseDown={(event) => {
          event.preventDefault();
        }}
        onClick={() => {
          player.setLoopEnd(name);
        }}
      >
        {name.toUpperCase()}
      </button>
    );
  };
  return (
    <span class="button-row transport-loop" role="group" aria-label="Loop">
      {end("a", a_s, "I")}
      {end("b", b_s, "O")}
      {a_s !== null && (
        <button
          type="button"
          class="button quiet"
          title="No loop (Shift+O)"
          aria-label="No loop"
          onMouseDown={(event) => {
            event.preventDefault();
          }}
          onClick={() => void player.loop(null)}
        >
          ✕
        </button>
      )}
    </span>
  );
}
