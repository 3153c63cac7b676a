import type { Station } from "../shell/station";
import { size } from "../units/size";
import { damageText } from "./marks";
import { clockTenths } from "./time_text";
import { Track } from "./track";
import { Transport } from "./transport";
import "./timeline.css";

/** At the foot of the page when a recording is open: where in it we are, what happened when, and how it is played. */
export function TimeLine({ station }: { station: Station }) {
  const { player, store } = station;
  if (player.name.value === "") return null;
  const info = player.info.value;
  const playback = store.playback.value;
  const open = playback !== null && playback.state !== "opening" && playback.state !== "failed";
  const damage = damageText(info?.damage ?? []);
  return (
    <section class="timeline" aria-label="Time line">
      <Transport station={station} disabled={!open} />
      <Track station={station} disabled={!open} />
      {damage !== "" && (
        <details class="timeline-damage">
          <summary>{damage}</summary>
          <Damage station={station} />
        </details>
      )}
    </section>
  );
}

const kMostTold = 100;

function Damage({ station }: { station: Station }) {
  const { player } = station;
  const damage = player.info.value?.damage ?? [];
  return (
    <ul aria-label="What can't be read">
      {damage.slice(0, kMostTold).map(({ t_s, bytes, reason }, i) => (
        <li key={i}>
          <button
            type="button"
            class="button quiet"
            onClick={() => {
              player.seek(t_s);
            }}
          >
            {clockTenths(t_s)}
          </button>{" "}
          {size(bytes)}: {reason}
        </li>
      ))}
      {damage.length > kMostTold && <li>And {damage.length - kMostTold} more.</li>}
    </ul>
  );
}
