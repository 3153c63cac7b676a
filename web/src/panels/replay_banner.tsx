import { useEffect } from "preact/hooks";
import { replay } from "../state/replay";
import "./replay_banner.css";

/** Across the page while it shows what has been: nobody may take it for what is. `live`: there is a live flight to go back to. */
export function ReplayBanner({ live }: { live: boolean }) {
  const shown = replay.value;
  const name = shown?.name ?? "";
  useEffect(() => {
    document.title = name === "" ? "Skein" : `REPLAY ${name} \u2013 Skein`;
  }, [name]);
  if (shown === null || shown.name === "") return null;
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
      {shown.kind === "log" && live && (
        // Without a name there is the live flight.
        <a class="button" href={location.pathname}>
          Back to live
        </a>
      )}
    </section>
  );
}
