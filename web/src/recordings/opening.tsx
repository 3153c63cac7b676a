import type { Station } from "../shell/station";
import { replay } from "../state/replay";
import { RecordingList } from "./recording_list";
import { openingProblem } from "./opening_problem";
import "./recordings.css";

/** In the middle of the page while no recording is to be seen yet: how far it is, why it can't be, or which there are. */
export function Opening({ station }: { station: Station }) {
  const { store } = station;
  const shown = replay.value;
  if (shown === null || shown.kind !== "log") return null;
  if (shown.name === "") return <Choose station={station} />;
  const playback = store.playback.value;
  const problem = openingProblem(station);
  if (problem !== "") {
    return (
      <section class="panel opening" aria-labelledby="opening-title" role="alert">
        <h2 id="opening-title">{shown.name} can't be opened</h2>
        <p>{problem}</p>
        <p>
          <a class="button" href={location.pathname}>
            {store.hello.value?.recordings?.live_bus === false ? "All recordings" : "Leave this recording"}
          </a>
        </p>
      </section>
    );
  }
  if (playback?.state !== "opening" && playback !== null) return null;
  const progress = playback?.progress ?? 0;
  const percent = Math.floor(progress * 100);
  return (
    <section class="panel opening" aria-labelledby="opening-title">
      <h2 id="opening-title">Opening {shown.name}</h2>
      <p>It is read once from end to end, so that any moment can be shown at once.</p>
      <progress max={1} value={progress} aria-label={`Opening, ${percent} %`} />
      <p class="hint">{percent} %</p>
    </section>
  );
}

function Choose({ station }: { station: Station }) {
  return (
    <section class="panel choose" aria-labelledby="choose-title">
      <h2 id="choose-title">Recordings</h2>
      <RecordingList station={station} />
    </section>
  );
}
