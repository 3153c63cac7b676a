import { Icon } from "../shell/icon";
import type { PanelProps } from "../shell/panel_props";
import { Popover } from "../shell/popover";
import { replay } from "../state/replay";
import { countdown, kSeverityNames } from "./alarm_list";
import { heard, heard_in_replay, mute, muted_s, soundBlocked, tryOut, volume_percent } from "./sound";

const kMutes = [
  [60, "1 min"],
  [300, "5 min"],
] as const;

/** Silence for a while, always with the time that is left in sight; how loud, and what is heard at all. */
export function SoundMenu({ station }: PanelProps) {
  const now_ms = station.store.now_ms.value;
  const left_s = muted_s(now_ms);
  const in_replay = replay.value !== null;
  const silent =
    (in_replay && !heard_in_replay.value) ||
    volume_percent.value === 0 ||
    !Object.values(heard).some(({ value }) => value);
  const blocked = soundBlocked();
  const state = blocked
    ? "off until this page is clicked or a key is pressed"
    : left_s > 0
      ? `muted for ${countdown(left_s)}`
      : silent
        ? "off"
        : "on";
  return (
    <Popover
      class="bar-button sound-button"
      label={`Sound of alarms: ${state}`}
      button={
        <>
          <Icon name={blocked || silent || left_s > 0 ? "muted" : "sound"} />
          {left_s > 0 && <span class="mute-left">{countdown(left_s)}</span>}
          {left_s === 0 && blocked && <span class="mute-left">Enable</span>}
        </>
      }
    >
      <h2>Sound of alarms</h2>
      {/* Opening this menu was a gesture, so it is heard from here on. */}
      <div class="sound-line" role="group" aria-label="Mute">
        <span>{left_s > 0 ? `Muted, ${countdown(left_s)} left` : "Mute for"}</span>
        {kMutes.map(([duration_s, name]) => (
          <button
            key={duration_s}
            type="button"
            class="button"
            aria-label={`Mute for ${name}`}
            title={duration_s === 60 ? "Mute for 1 min (Shift+M)" : `Mute for ${name}`}
            onClick={() => {
              mute(duration_s);
            }}
          >
            {name}
          </button>
        ))}
        <button
          type="button"
          class="button"
          disabled={left_s === 0}
          onClick={() => {
            mute(0);
          }}
        >
          Unmute
        </button>
      </div>
      <label class="sound-line">
        <span>Volume</span>
        <input
          type="range"
          min={0}
          max={100}
          step={5}
          value={volume_percent.value}
          aria-valuetext={`${volume_percent.value} %`}
          onInput={(event) => {
            volume_percent.value = event.currentTarget.valueAsNumber;
          }}
        />
        <output>{volume_percent.value} %</output>
      </label>
      {([3, 2, 1] as const).map((severity) => {
        const name = kSeverityNames[severity];
        return (
          <div class="sound-line" key={severity}>
            <label class="check">
              <input
                type="checkbox"
                checked={heard[severity].value}
                onChange={(event) => {
                  heard[severity].value = event.currentTarget.checked;
                }}
              />
              {name}
            </label>
            <button
              type="button"
              class="button"
              aria-label={`Hear how a ${name.toLowerCase()} sounds`}
              onClick={() => {
                tryOut(severity);
              }}
            >
              Listen
            </button>
          </div>
        );
      })}
      {in_replay && (
        <label class="check">
          <input
            type="checkbox"
            checked={heard_in_replay.value}
            onChange={(event) => {
              heard_in_replay.value = event.currentTarget.checked;
            }}
          />
          Hear the alarms of this replay
        </label>
      )}
      <p class="hint">For this browser alone. What flashes goes on flashing.</p>
    </Popover>
  );
}
