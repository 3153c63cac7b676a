import { kMonitor, whyNoAlarms } from "../alarms/service";
import type { Store } from "../state/store";
import { replay } from "../state/replay";
import { duration, utc } from "../units/format";

/** Over the map when what it shows is old: why, since when, and what is done about it. */
export function LinkBanner({ store, retry }: { store: Store; retry: () => void }) {
  const now_ms = store.now_ms.value;
  const connection = store.connection.value;
  const replayed = replay.value?.kind === "log";
  const last_utime = store.fleet.motion?.utime;
  const old = last_utime === undefined ? "" : ` The fleet is shown as it was at ${utc(last_utime)} UTC.`;

  if (connection.kind !== "open") {
    if (connection.kind === "connecting" && store.hello.value === null) return null;
    const wait_s =
      connection.kind === "waiting" ? Math.max(0, Math.ceil((connection.retry_at_ms - now_ms) / 1000)) : 0;
    return (
      <div class="banner" role="status">
        <p>
          <strong>Reconnecting to web-bridge…{replayed ? "" : " No alarms can come."}</strong>
          {old}
        </p>
        <p class="detail">{wait_s > 0 ? `Next attempt in ${wait_s} s.` : "Trying now."}</p>
        <button type="button" class="button" onClick={retry}>
          Try now
        </button>
      </div>
    );
  }

  const silence_s = store.busSilence_s(now_ms);
  const silent = store.silent_nodes.value;
  const no_alarms = whyNoAlarms(store, now_ms);
  const sentences = [
    silence_s === null ? "" : `No telemetry for ${duration(silence_s)}.`,
    silent.length === 0 ? "" : `Not heard: ${silent.join(", ")}.`,
    silent.includes(kMonitor) && !replayed ? "No alarms can come." : no_alarms,
  ].filter(Boolean);
  if (sentences.length === 0) return null;
  return (
    <div class="banner" role="status">
      <p>
        <strong>{sentences.join(" ")}</strong>
        {silence_s !== null && old}
      </p>
      {!replayed && (
        <p class="detail">
          {silence_s === null
            ? "It is taken up again as soon as it is back."
            : "Reconnects by itself when the bus is back."}
        </p>
      )}
    </div>
  );
}
