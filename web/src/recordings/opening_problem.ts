import type { Station } from "../shell/station";
import { replay } from "../state/replay";

/** Why the recording that the page is for can't be opened; "" while it can, or when it is for none. */
export function openingProblem({ player, store }: Station): string {
  if (replay.value?.kind !== "log") return "";
  const playback = store.playback.value;
  if (playback?.state === "failed") return playback.problem;
  // A connection that once was there comes back.
  return playback === null ? player.problem.value : "";
}
