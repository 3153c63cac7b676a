import { useRef } from "preact/hooks";
import { Icon, type IconName } from "../shell/icon";
import { useShortcuts } from "../shell/shortcuts";
import type { Station } from "../shell/station";
import { fixed, kNone, utc } from "../units/format";
import { GoTo } from "./go_to";
import { LoopEnds } from "./loop_ends";
import { landmarkFrom } from "./marks";
import type { Player } from "./player";
import { kSpeeds } from "./playing";
import { clockTenths, utcDay } from "./time_text";
import { useFrameTime } from "./use_frame_time";

export interface TransportProps {
  station: Station;
  disabled: boolean;
}

const kGroup = "Recording";

/** Plays, steps, jumps; how fast; what time it is; the loop. */
export function Transport({ station, disabled }: TransportProps) {
  const { player, store } = station;
  const go_to = useRef<HTMLInputElement>(null);
  const by_pointer = useRef(false);
  const playback = store.playback.value;
  const playing = playback?.state === "playing";
  const direction = playback?.direction ?? 1;
  const jump = (way: 1 | -1) => {
    jumpToLandmark(player, way);
  };
  useShortcuts(
    (
      [
        ["Space", "Play or pause", () => void player.toggle(1)],
        ["j", "Play backwards or pause", () => void player.toggle(-1)],
        [".", "A step of 0.05 s on", () => void player.step(1)],
        [",", "A step of 0.05 s back", () => void player.step(-1)],
        [
          "Ctrl+ArrowRight",
          "Next alarm or marker",
          () => {
            jump(1);
          },
        ],
        [
          "Ctrl+ArrowLeft",
          "Alarm or marker before",
          () => {
            jump(-1);
          },
        ],
        [">", "Faster", () => void player.changeSpeed(1)],
        ["<", "Slower", () => void player.changeSpeed(-1)],
        [
          "g",
          "Go to a time",
          () => {
            go_to.current?.focus();
          },
        ],
        [
          "i",
          "A: the loop begins here",
          () => {
            player.setLoopEnd("a");
          },
        ],
        [
          "o",
          "B: the loop ends here",
          () => {
            player.setLoopEnd("b");
          },
        ],
        ["Shift+o", "No loop", () => void player.loop(null)],
      ] as const
    ).map(([keys, label, run]) => ({ keys, label, group: kGroup, run })),
  );
  const button = (icon: IconName, label: string, key: string, run: () => void) => (
    <button
      type="button"
      class={`bar-button transport-${icon}`}
      aria-label={label}
      title={`${label} (${key})`}
      disabled={disabled}
      // A press of the mouse leaves the focus where it is, so that Space goes on playing and pausing.
      onMouseDown={(event) => {
        event.preventDefault();
      }}
      onClick={run}
    >
      <Icon name={icon} />
    </button>
  );
  const forwards = playing && direction === 1;
  const backwards = playing && direction === -1;
  return (
    <div class="transport" role="group" aria-label="Playing">
      <span class="transport-keys">
        {button("previous", "Alarm or marker before", "Ctrl+←", () => {
          jump(-1);
        })}
        {button(
          backwards ? "hold" : "backwards",
          backwards ? "Pause" : "Play backwards",
          "J",
          () => void player.toggle(-1),
        )}
        {button("step_back", "Step back", ",", () => void player.step(-1))}
        {button(
          forwards ? "hold" : "play",
          forwards ? "Pause" : "Play",
          "Space",
          () => void player.toggle(1),
        )}
        {button("step", "Step on", ".", () => void player.step(1))}
        {button("next", "Next alarm or marker", "Ctrl+→", () => {
          jump(1);
        })}
      </span>
      <label class="transport-speed">
        <span class="visually-hidden">Speed</span>
        <select
          class="field"
          title="How fast it is played (< and >)"
          disabled={disabled}
          value={String(playback?.speed ?? 1)}
          onPointerDown={() => {
            by_pointer.current = true;
          }}
          onKeyDown={() => {
            by_pointer.current = false;
          }}
          onChange={(event) => {
            // As with the buttons: Space goes on playing and pausing. Arrow keys go on choosing.
            if (by_pointer.current) event.currentTarget.blur();
            void player.setSpeed(Number(event.currentTarget.value));
          }}
        >
          {speeds(playback?.speed ?? 1).map((speed) => (
            <option key={speed} value={String(speed)}>
              {fixed(speed, speed < 1 ? (speed === 0.25 ? 2 : 1) : 0)}×
            </option>
          ))}
        </select>
      </label>
      <Times player={player} />
      <GoTo player={player} disabled={disabled} input={go_to} />
      <LoopEnds station={station} disabled={disabled} />
      {player.refusal.value !== "" && (
        <p class="transport-refusal" role="alert">
          {player.refusal.value}
          <button
            type="button"
            class="button quiet"
            aria-label="Dismiss"
            onClick={() => {
              player.refusal.value = "";
            }}
          >
            ✕
          </button>
        </p>
      )}
    </div>
  );
}

/** The usual ones, and the one that is played, whoever has chosen it. */
function speeds(played: number): number[] {
  return [...new Set([...kSpeeds, played])].sort((a, b) => a - b);
}

function jumpToLandmark(player: Player, way: 1 | -1): void {
  const marks = player.info.value?.marks ?? [];
  const mark = landmarkFrom(marks, player.at_s(performance.now()), way, player.playing());
  if (mark !== null) player.seek(mark.t_s);
  else
    player.refusal.value = marks.some(({ kind }) => kind !== "event")
      ? `No alarm or marker ${way === 1 ? "after" : "before"} this.`
      : "There is no alarm or marker in this recording.";
}

/** Into the recording, of how much; and what the clock said then. */
function Times({ player }: { player: Player }) {
  const at_s = useFrameTime(player);
  const start_utime = player.start_utime();
  const utime = start_utime === null ? null : start_utime + at_s * 1e6;
  return (
    <dl class="transport-times">
      <div>
        <dt class="visually-hidden">Into the recording</dt>
        <dd>
          <span class="transport-now">{clockTenths(at_s)}</span>
          <span class="transport-length"> / {clockTenths(player.duration_s()).slice(0, -2)}</span>
        </dd>
      </div>
      <div class="transport-wall">
        <dt class="visually-hidden">The clock then</dt>
        <dd>
          {utime === null ? (
            kNone
          ) : (
            <>
              <span class="transport-day">{utcDay(utime)} </span>
              {utc(utime)} UTC
            </>
          )}
        </dd>
      </div>
    </dl>
  );
}
