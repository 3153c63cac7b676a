import { useSignal } from "@preact/signals";
import type { ListedRecording } from "../link/recording_messages";
import { Lamp } from "../panels/icons";
import type { Station } from "../shell/station";
import { DeleteDialog, whyNoDelete } from "./delete_dialog";
import "./recordings.css";
import { useRecordings } from "./use_recordings";
import { alarmsText, fileOf, found, pageOf, whatText, whenText } from "./words";

/** With more than that a person wants to search. */
const kSearchFrom = 8;

/** All recordings, newest first: opened by a click. */
export function RecordingList({ station }: { station: Station }) {
  const { list, problem, ask } = useRecordings(station.api);
  const text = useSignal("");
  const to_delete = useSignal<ListedRecording | null>(null);
  if (list === null)
    return (
      <p class="empty" role="status">
        {problem === "" ? "Asking for the recordings…" : `The list can't be had: ${problem} Trying again.`}
      </p>
    );
  const shown = found(list.recordings, text.value);
  return (
    <>
      {list.recordings.length > kSearchFrom && (
        <input
          type="search"
          class="field recordings-search"
          placeholder="Search: a scenario, a day"
          aria-label="Search recordings"
          value={text.value}
          onInput={(event) => {
            text.value = event.currentTarget.value;
          }}
        />
      )}
      {problem !== "" && (
        <p class="empty" role="status">
          This list is old: {problem} Trying again.
        </p>
      )}
      {list.recordings.length === 0 ? (
        <p class="empty">
          There is no recording in <code>{list.folder}</code>. Each flight that <code>scripts/run</code>{" "}
          starts is recorded there.
        </p>
      ) : shown.length === 0 ? (
        <p class="empty">No recording is like that: take another word.</p>
      ) : (
        <ul
          class="recording-list"
          aria-label={`Recordings, newest first: ${shown.length} of ${list.recordings.length}`}
        >
          {shown.map((recording) => (
            <Recording
              key={recording.name}
              recording={recording}
              open={recording.name === station.player.name.value}
              no_delete={whyNoDelete(recording, list.live_bus)}
              remove={() => {
                to_delete.value = recording;
              }}
            />
          ))}
        </ul>
      )}
      {list.recordings.length > 0 && (
        <p class="hint recordings-folder">
          In <code>{list.folder}</code>
        </p>
      )}
      {to_delete.value !== null && (
        <DeleteDialog
          station={station}
          recording={to_delete.value}
          close={() => {
            to_delete.value = null;
            ask();
          }}
        />
      )}
    </>
  );
}

interface RecordingProps {
  recording: ListedRecording;
  /** It is the one that the page shows. */
  open: boolean;
  /** Why it can't be deleted; "". */
  no_delete: string;
  remove: () => void;
}

function Recording({ recording, open, no_delete, remove }: RecordingProps) {
  const { name, scenario, parts, problem, recording_now, warnings } = recording;
  const [when, what, alarms] = [whenText(recording), whatText(recording), alarmsText(recording)];
  const title = scenario === null || scenario === "" ? name : scenario;
  return (
    <li class={open ? "recording open" : "recording"} aria-current={open}>
      <h3>
        {problem === "" ? (
          <a href={pageOf(name)} title={`Open ${name}`}>
            {title}
          </a>
        ) : (
          title
        )}
        {recording_now && <span class="recording-now">being recorded</span>}
        {open && <span class="recording-now">open</span>}
      </h3>
      {when !== "" && <p>{when}</p>}
      <p class="recording-what">
        {what}
        {alarms !== "" && (
          <span class="recording-alarms">
            {(warnings ?? 0) > 0 && <Lamp level={3} />}
            {alarms}
          </span>
        )}
      </p>
      {problem !== "" && <p class="recording-problem">Can't be opened: {problem}</p>}
      {problem === "" && !recording.indexed && (
        <label class="recording-progress">
          <span>Being read</span>
          <progress max={1} value={recording.progress} />
        </label>
      )}
      <p class="recording-file">{name}</p>
      <div class="recording-actions">
        {problem === "" && (
          <a class="button" href={pageOf(name)} aria-label={`Open ${name}`}>
            Open
          </a>
        )}
        {parts === 1 ? (
          <a class="button" href={fileOf(name, 0)} download={name} aria-label={`Download ${name}`}>
            Download
          </a>
        ) : (
          <Parts name={name} parts={parts} />
        )}
        <button
          type="button"
          class="button"
          aria-label={`Delete ${name}…`}
          aria-disabled={no_delete !== ""}
          title={no_delete === "" ? `Delete ${name}…` : `Delete ${name}: ${no_delete}`}
          onClick={() => {
            if (no_delete === "") remove();
          }}
        >
          Delete…
        </button>
      </div>
    </li>
  );
}

/** The parts of a recording that was split, one by one. */
function Parts({ name, parts }: { name: string; parts: number }) {
  return (
    <details class="recording-parts">
      <summary class="button" aria-label={`Download ${name}, ${parts} parts`}>
        Download
      </summary>
      <ul>
        {Array.from({ length: parts }, (_, part) => (
          <li key={part}>
            <a href={fileOf(name, part)} download>
              Part {part + 1}
            </a>
          </li>
        ))}
      </ul>
    </details>
  );
}
