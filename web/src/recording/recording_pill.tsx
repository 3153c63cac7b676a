import { useSignal } from "@preact/signals";
import { useId, useLayoutEffect, useRef } from "preact/hooks";
import type { Commands } from "../link/commands";
import type { RecordingStatus } from "../link/messages";
import { CommandButton } from "../panels/command_button";
import type { PanelProps } from "../shell/panel_props";
import { Popover } from "../shell/popover";
import { useShortcuts } from "../shell/shortcuts";
import { clock } from "../units/format";
import { size } from "../units/size";
import { kLongestMarker, markerProblem, recordingView, sendRecording, type RecordingView } from "./recording";
import "./recording.css";

type Shown = Exclude<RecordingView, { kind: "none" }>;

/** Whether the flight is recorded: always in sight, and what can be done about it. */
export function RecordingPill({ station }: PanelProps) {
  const root = useRef<HTMLDivElement>(null);
  useShortcuts([
    {
      keys: "k",
      label: "Put a marker into the recording",
      group: "Flight",
      run: () => {
        root.current?.querySelector<HTMLButtonElement>('.recording-pill[aria-expanded="false"]')?.click();
      },
    },
  ]);
  const view = recordingView(station.store, station.store.now_ms.value);
  if (view.kind === "none") return null;
  const label =
    view.kind === "recording"
      ? `Rec ${clock(view.elapsed_s)} ${size(view.status.bytes)}: the flight is recorded. Recording… (K)`
      : `Not recording: ${view.why}. Recording… (K)`;
  return (
    <div class="recording" ref={root}>
      <Popover
        label={label}
        class={`recording-pill ${view.kind === "recording" ? "on" : "off"}`}
        button={
          view.kind === "recording" ? (
            <>
              <svg viewBox="0 0 10 10" aria-hidden="true">
                <circle cx="5" cy="5" r="4" />
              </svg>
              <span>Rec</span> <span class="recording-time">{clock(view.elapsed_s)}</span>{" "}
              <span class="recording-size">{size(view.status.bytes)}</span>
            </>
          ) : (
            <>
              <svg viewBox="0 0 10 10" aria-hidden="true">
                <path d="M1 1L9 9M9 1L1 9" />
              </svg>
              <span class="recording-word">Not recording</span>
            </>
          )
        }
      >
        <RecordingMenu view={view} commands={station.commands} />
      </Popover>
    </div>
  );
}

function RecordingMenu({ view, commands }: { view: Shown; commands: Commands }) {
  return (
    <div class="recording-menu">
      <h2>Recording</h2>
      {view.kind === "recording" ? <Facts status={view.status} /> : <p>Not recording: {view.why}.</p>}
      {view.kind === "not" && view.reachable && view.wanted && <p class="hint">It goes on by itself.</p>}
      {(view.kind === "recording" || view.wanted) && (view.kind === "recording" || view.reachable) && (
        <CommandButton label="Stop recording" command={() => sendRecording(commands, { action: "stop" })}>
          Stop
        </CommandButton>
      )}
      {view.kind === "not" && view.reachable && !view.wanted && (
        <CommandButton
          class="button primary"
          label="Start recording"
          command={() => sendRecording(commands, { action: "start" })}
        >
          Start
        </CommandButton>
      )}
      <MarkerForm commands={commands} reachable={view.kind === "recording" || view.reachable} />
    </div>
  );
}

function Facts({ status }: { status: RecordingStatus }) {
  return (
    <dl class="recording-facts">
      <dt>File</dt>
      <dd title={`${status.folder}/${status.part}`}>{status.recording}</dd>
      <dt>Size</dt>
      <dd>
        {size(status.bytes)}
        {status.parts > 1 && ` in ${status.parts} files`}
      </dd>
      <dt>Disk</dt>
      <dd>{status.free_bytes < 0 ? "not known" : `${size(status.free_bytes)} free`}</dd>
    </dl>
  );
}

/** A note for whoever sees the recording later, and for all who see this flight. It stays while there is nobody to write it down. */
function MarkerForm({ commands, reachable }: { commands: Commands; reachable: boolean }) {
  const text = useSignal("");
  const put = useSignal("");
  const form = useRef<HTMLFormElement>(null);
  const field = useRef<HTMLInputElement>(null);
  const id = useId();
  // Not an effect after painting: what is typed until then would be shortcuts.
  useLayoutEffect(() => {
    field.current?.focus();
  }, []);
  const problem = markerProblem(text.value);
  const send = async () => {
    const note = text.value.trim();
    const outcome = await sendRecording(commands, { action: "marker", text: note });
    if (outcome.accepted) {
      text.value = "";
      put.value = `Put: ${note}${outcome.reason === "" ? "" : ` (${outcome.reason})`}`;
    }
    return outcome;
  };
  return (
    <form
      class="marker-form"
      ref={form}
      onSubmit={(event) => {
        event.preventDefault();
        form.current?.querySelector("button")?.click();
      }}
    >
      <label for={id}>Marker</label>
      <input
        id={id}
        ref={field}
        class="field"
        type="text"
        autocomplete="off"
        placeholder="What is to be noted"
        maxLength={2 * kLongestMarker}
        value={text.value}
        aria-describedby={`${id}-put`}
        onInput={(event) => {
          text.value = event.currentTarget.value;
          put.value = "";
        }}
      />
      <CommandButton label="Put the marker" disabled={!reachable || problem !== ""} command={send}>
        Put
      </CommandButton>
      <p id={`${id}-put`} class="hint" role="status">
        {put.value || (text.value === "" ? "" : problem)}
      </p>
    </form>
  );
}
