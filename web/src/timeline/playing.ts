/** How a recording is played, in pure functions. Times are seconds since its first event. */
import type { PlaybackMessage } from "../link/recording_messages";

export interface Span {
  from_s: number;
  to_s: number;
}

export const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50] as const;
/** The bridge's: anything shorter would be a standing picture. */
const kShortestLoop_s = 0.2;

/** The next faster (1) or slower (-1) of the usual speeds. */
export function nextSpeed(speed: number, steps: 1 | -1): number {
  const next = steps === 1 ? kSpeeds.find((one) => one > speed) : kSpeeds.findLast((one) => one < speed);
  return next ?? speed;
}

/** Where it is `since_s` after the bridge said how it plays: not past its ends, nor those of a loop. */
export function timeAt(playback: PlaybackMessage, since_s: number): number {
  if (playback.state !== "playing") return playback.t_s;
  const { t_s, speed, direction, loop, duration_s } = playback;
  const [from_s, to_s] =
    loop !== null && t_s >= loop[0] && t_s <= loop[1] ? loop : ([0, duration_s] as const);
  return Math.min(Math.max(t_s + direction * speed * since_s, from_s), to_s);
}

/** What is wrong with a loop between these two; "" when nothing is. */
export function loopProblem(a_s: number, b_s: number): string {
  return b_s - a_s >= kShortestLoop_s ? "" : "B must be after A: go there and set it again.";
}
