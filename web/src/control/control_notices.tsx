import { useEffect } from "preact/hooks";
import { CommandButton } from "../panels/command_button";
import type { PanelProps } from "../shell/panel_props";
import { TakeOver } from "./take_over";
import { holderOf, othersOf, youHold, youOf } from "./people";

const kShowNews_ms = 20_000;

/** Over the map: who asks the holder for control, how one's own request stands, and what has become of control. */
export function ControlNotices({ station }: PanelProps) {
  const { control, store } = station;
  const state = control.state.value;
  if (state === null || store.connection.value.kind !== "open") return null;
  const since_s = (store.now_ms.value - control.arrival_ms) / 1000;
  const asking = youHold(state) ? othersOf(state).filter(({ waits_for_s }) => waits_for_s !== null) : [];
  const waits_for_s = youHold(state) ? null : (youOf(state)?.waits_for_s ?? null);
  return (
    <>
      {asking.map(({ id, name, waits_for_s: left_s }) => (
        <div key={id} class="notice request" role="alert">
          <p>
            <strong>{name} asks for control.</strong>{" "}
            <span class="detail">
              {left_s !== null && left_s > since_s
                ? `Without an answer ${name} may take over in ${Math.ceil(left_s - since_s)} s.`
                : `${name} may take over now.`}
            </span>
          </p>
          <CommandButton
            always
            class="button primary"
            label={`Give control to ${name}`}
            command={() => control.give(id)}
          >
            Give control
          </CommandButton>
          <CommandButton always label={`Keep control, refuse ${name}`} command={() => control.refuse(id)}>
            Keep control
          </CommandButton>
        </div>
      ))}
      {waits_for_s !== null && (
        <div class="notice">
          <TakeOver
            control={control}
            holder={holderOf(state)?.name ?? "Nobody"}
            left_s={Math.max(0, waits_for_s - since_s)}
          />
        </div>
      )}
      {control.news.value !== "" && (
        <News
          key={control.news.value}
          text={control.news.value}
          dismiss={() => {
            control.news.value = "";
          }}
        />
      )}
    </>
  );
}

function News({ text, dismiss }: { text: string; dismiss: () => void }) {
  useEffect(() => {
    const timer = setTimeout(dismiss, kShowNews_ms);
    return () => {
      clearTimeout(timer);
    };
    // It is shown for so long from when it came, however often it is drawn.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, []);
  return (
    <div class="notice" role="status">
      <p>
        <strong>{text}</strong>
      </p>
      <button type="button" class="button quiet" aria-label="Dismiss" title="Dismiss" onClick={dismiss}>
        ✕
      </button>
    </div>
  );
}
