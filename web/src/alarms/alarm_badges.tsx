import { effect, untracked } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { Lamp } from "../panels/icons";
import { showSide } from "../shell/layout";
import type { PanelProps } from "../shell/panel_props";
import { useShortcuts } from "../shell/shortcuts";
import { inChosenUnits } from "../units/station_text";
import { countsOf, countsText, groupsOf, kSeverityNames, wantsAcknowledgement } from "./alarm_list";
import "./alarms.css";
import { whyNoAlarms } from "./service";
import { AlarmSound, mute, muted_s } from "./sound";
import { SoundMenu } from "./sound_menu";

/** In the top bar: how many alarms there are, and the sound. It is always there, so the sound and the keys are its work. */
export function AlarmBadges({ station }: PanelProps) {
  const { store } = station;
  useEffect(() => {
    const sound = new AlarmSound(store);
    // Not on the beat alone: in a tab that is not looked at the browser lets it come once a minute.
    return effect(() => {
      void store.now_ms.value;
      void store.alarms.value;
      untracked(() => {
        sound.beat(performance.now());
      });
    });
  }, [store]);
  useShortcuts([
    {
      keys: "a",
      label: "Acknowledge the alarm that has the focus, or the most urgent",
      group: "Alarms",
      run: pressOne,
    },
    {
      keys: "Shift+a",
      label: "Acknowledge all alarms",
      group: "Alarms",
      run: () => press(".acknowledge-all"),
    },
    {
      keys: "Shift+m",
      label: "Mute the alarms' sound for a minute, or let it be heard again",
      group: "Alarms",
      run: () => {
        mute(muted_s(performance.now()) > 0 ? 0 : 60);
      },
    },
  ]);

  const list = store.alarms.value;
  const trouble = whyNoAlarms(store, store.now_ms.value);
  const counts = countsOf(list);
  const newest = groupsOf(list).open.find(wantsAcknowledgement);
  const label = trouble === "" ? `Alarms: ${countsText(counts)}` : trouble;
  return (
    <div class="alarm-badges" role="group" aria-label="Alarms">
      <button
        type="button"
        class={trouble === "" ? "badges" : "badges trouble"}
        title={label}
        onClick={() => {
          showSide("alarms");
        }}
      >
        {trouble !== "" && <span class="no-alarms">No alarms can come</span>}
        {trouble === "" &&
          counts
            .filter(({ severity, on, unacknowledged }) => severity > 1 || on + unacknowledged > 0)
            .map(({ severity, on, unacknowledged }) => (
              <span
                key={severity}
                class={`badge severity-${severity}${unacknowledged > 0 ? " flashes" : ""}${on + unacknowledged > 0 ? "" : " none"}`}
              >
                <Lamp level={severity} />
                {/* A flashing 0 would puzzle: what has ended, but nobody has seen, counts until somebody has. */}
                {on > 0 ? on : unacknowledged}
                {unacknowledged > 0 && <span class="visually-hidden">, {unacknowledged} unacknowledged</span>}
              </span>
            ))}
      </button>
      <SoundMenu station={station} />
      {/* Read out at once, once an occurrence. */}
      <p class="visually-hidden" role="alert">
        {newest === undefined
          ? ""
          : `${kSeverityNames[newest.severity] ?? ""}: ${inChosenUnits(newest.text)}`}
      </p>
    </div>
  );
}

/**
 * Presses a button of the panel, which has to be there first, and before a newer list may put another alarm there. The panel
 * shows a refusal beside it.
 */
function press(selector: string, from: ParentNode = document): void {
  showSide("alarms");
  queueMicrotask(() => from.querySelector<HTMLButtonElement>(selector)?.click());
}

function pressOne(): void {
  press(".acknowledge", document.activeElement?.closest(".alarm.flashes") ?? document);
}
