/** The sound of this browser: what its person wants to hear, and the beat on which it is played. */
import { signal } from "@preact/signals";
import { replay } from "../state/replay";
import type { Store } from "../state/store";
import { remembered, within, yesOrNo } from "../state/remembered";
import { whyNoAlarms } from "./service";
import { SoundPlayer } from "./sound_player";
import { SoundSchedule } from "./sound_schedule";

/** 0..100. */
export const volume_percent = remembered("alarms.volume", 60, within(0, 100));
export const heard = {
  3: remembered("alarms.sound.warning", true, yesOrNo),
  2: remembered("alarms.sound.caution", true, yesOrNo),
  1: remembered("alarms.sound.advisory", true, yesOrNo),
} as const;

/** What has been must not frighten anybody who flies now: a replay is silent, until somebody wants to hear it. */
export const heard_in_replay = signal(false);

/** Nothing is heard until then (performance.now). Forgotten with the page: a silence that nobody remembers is dangerous. */
export const muted_until_ms = signal(0);

/** For how long it will be silent [s]; 0: it is not muted. */
export function muted_s(now_ms: number): number {
  return Math.max(0, (muted_until_ms.value - now_ms) / 1000);
}

export function mute(duration_s: number): void {
  muted_until_ms.value = duration_s > 0 ? performance.now() + duration_s * 1000 : 0;
}

const player = new SoundPlayer();

/** The browser lets nothing be heard before the person touches the page. */
export function soundBlocked(): boolean {
  return player.blocked;
}

/** Lets a pattern be heard, to know it and to set the volume. */
export function tryOut(severity: number): void {
  player.play(severity, volume_percent.value / 100);
}

export function wanted(severity: number): boolean {
  return severity === 1 || severity === 2 || severity === 3 ? heard[severity].value : false;
}

/** To be called on the store's beat. */
export class AlarmSound {
  private readonly schedule = new SoundSchedule();
  private told = "";

  constructor(private readonly store: Store) {}

  beat(now_ms: number): void {
    if (replay.value !== null && !heard_in_replay.value) return;
    // What can't be heard is not counted as heard: it sounds when it can be.
    if (player.blocked || muted_s(now_ms) > 0) return;
    const trouble = whyNoAlarms(this.store, now_ms);
    const lost = trouble !== "" && this.told === "" && wanted(2);
    this.told = trouble;
    const severity = this.schedule.next(trouble === "" ? this.store.alarms.value : null, now_ms, wanted);
    if (severity > 0 || lost) player.play(Math.max(severity, lost ? 2 : 0), volume_percent.value / 100);
  }
}
