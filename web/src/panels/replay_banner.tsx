import { replay } from "../state/replay";
import "./replay_banner.css";

/** Across the page while it shows what has been: nobody may take it for what is. `live_url`: where the live flight is, null: nowhere. */
export function ReplayBanner({ live_url }: { live_url: string | null }) {
  const shown = replay.value;
  if (shown === null) return null;
  return (
    <section class="replay-banner" aria-label="Replay">
      <strong>REPLAY</strong>
      <span class="replay-name" title={shown.name}>
        {shown.name}
        {shown.speed !== undefined && shown.speed !== 1 && `, ${shown.speed} times as fast`}
      </span>
      <span class="replay-why">
        {shown.kind === "player" ? "Played on this bus by lcm-logplayer. " : ""}Nothing here happens now, and
        nothing can be commanded.
      </span>
      {live_url !== null && (
        <a class="button" href={live_url}>
          Back to live
        </a>
      )}
    </section>
  );
}
