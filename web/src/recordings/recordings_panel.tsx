import type { PanelProps } from "../shell/panel_props";
import { RecordingList } from "./recording_list";

/** The recordings that the bridge serves. */
export function RecordingsPanel({ station }: PanelProps) {
  const served = station.store.hello.value?.recordings ?? null;
  return (
    <section class="recordings" aria-label="Recordings">
      {served === null ? (
        <div class="empty">
          <p>This bridge serves no recordings. To look at some, start it with their folder:</p>
          <p>
            <code>web-bridge --logs logs</code>
          </p>
        </div>
      ) : served.only !== null ? (
        <p class="empty">
          This bridge serves {served.only} alone. With <code>--logs</code> and a folder it serves all that are
          in it.
        </p>
      ) : (
        <RecordingList station={station} />
      )}
    </section>
  );
}
