import { RecordingPill } from "../recording/recording_pill";
import { ControlPill } from "../control/control_pill";
import { AlarmBadges } from "../alarms/alarm_badges";
import { HoldControl } from "../formation/hold_control";
import { nothingIsOpen, replay } from "../state/replay";
import type { Store } from "../state/store";
import { Brand } from "../panels/icons";
import { clock, kNone, utc } from "../units/format";
import { help_open } from "./help";
import { Icon } from "./icon";
import type { PanelProps } from "./panel_props";
import { SettingsMenu } from "./settings_menu";

/** What must always be in sight and in reach. */
export function TopBar({ station }: PanelProps) {
  const { store } = station;
  const roster = store.roster.value;
  return (
    <header class="top-bar">
      <Brand />
      <h1>Skein</h1>
      <span class="scenario" title={roster?.scenario}>
        {roster?.scenario ?? ""}
      </span>
      <Clock store={store} />
      <HoldControl station={station} />
      <ControlPill station={station} />
      <AlarmBadges station={station} />
      <RecordingPill station={station} />
      <ConnectionPill store={store} />
      <SettingsMenu session={station.session} />
      <button
        type="button"
        class="bar-button"
        aria-label="Keyboard help"
        title="Keyboard help (?)"
        onClick={() => {
          help_open.value = true;
        }}
      >
        <Icon name="help" />
      </button>
    </header>
  );
}

function Clock({ store }: { store: Store }) {
  const utime = store.utimeAt(store.now_ms.value);
  const start_utime = store.roster.value?.start_utime ?? 0;
  return (
    <dl class="clock">
      <div>
        <dt title="Since the scenario's start">T+</dt>
        <dd class="elapsed">
          {utime === null || start_utime === 0 ? kNone : clock((utime - start_utime) / 1e6)}
        </dd>
      </div>
      <div>
        <dt>UTC</dt>
        <dd class="utc">{utime === null ? kNone : utc(utime)}</dd>
      </div>
    </dl>
  );
}

/** How the page hears the fleet, in a word: always in sight. */
function ConnectionPill({ store }: { store: Store }) {
  const [state, text] = connectionWord(store, store.now_ms.value);
  return (
    <span class={`pill ${state}`} role="status" aria-label={`Connection: ${text}`}>
      <svg viewBox="0 0 10 10" aria-hidden="true">
        {state === "gone" ? <path d="M1 1L9 9M9 1L1 9" /> : <circle cx="5" cy="5" r="4" />}
      </svg>
      {text}
    </span>
  );
}

function connectionWord(store: Store, now_ms: number): ["live" | "waiting" | "gone", string] {
  const connection = store.connection.value;
  if (connection.kind === "signed out") return ["gone", "Signed out"];
  if (connection.kind === "waiting") return ["gone", "Reconnecting…"];
  if (connection.kind === "connecting")
    return [
      store.hello.value === null ? "waiting" : "gone",
      store.hello.value === null ? "Connecting…" : "Reconnecting…",
    ];
  if (nothingIsOpen(replay.value)) return ["waiting", "No recording open"];
  if (store.busSilence_s(now_ms) !== null) return ["gone", "Bus silent"];
  if (store.fleet.motion === null) return ["waiting", "No fleet yet"];
  if (store.silent_nodes.value.length > 0) return ["gone", "Part of the bus silent"];
  return ["live", replay.value === null ? "Live" : "Replay"];
}
