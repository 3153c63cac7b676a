import { useEffect, useState } from "preact/hooks";
import type { Player } from "./player";

/** As smooth as tenths of a second need it. */
const kInterval_ms = 50;

/** What is played now [s]; drawn anew as time goes on, and only then. */
export function useFrameTime(player: Player): number {
  const [now_ms, setNow] = useState(performance.now());
  const playing = player.playing();
  useEffect(() => {
    if (!playing) return;
    let last_ms = 0;
    let request = requestAnimationFrame(function frame() {
      request = requestAnimationFrame(frame);
      const time_ms = performance.now();
      if (time_ms - last_ms < kInterval_ms) return;
      last_ms = time_ms;
      setNow(time_ms);
    });
    return () => {
      cancelAnimationFrame(request);
    };
  }, [playing]);
  return player.at_s(playing ? now_ms : performance.now());
}
