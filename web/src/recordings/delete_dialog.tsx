import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { why_no_command } from "../control/control";
import type { ListedRecording } from "../link/recording_messages";
import type { Station } from "../shell/station";
import { replay } from "../state/replay";
import { whatText, whenText } from "./words";

/** Why a recording can't be deleted from this page; "" when it can. */
export function whyNoDelete({ recording_now }: ListedRecording, live_bus: boolean): string {
  if (recording_now) return "it is being recorded";
  if (!live_bus) return "";
  if (replay.value !== null) return "go back to live first; who holds control there may";
  return why_no_command.value;
}

interface DeleteDialogProps {
  station: Station;
  recording: ListedRecording;
  close: () => void;
}

/** Asks once more, naming what would be gone. A refusal is told here. */
export function DeleteDialog({ station, recording, close }: DeleteDialogProps) {
  const { name } = recording;
  const dialog = useRef<HTMLDialogElement>(null);
  const busy = useSignal(false);
  const refusal = useSignal("");
  useLayoutEffect(() => {
    dialog.current?.showModal();
  }, []);
  const remove = async () => {
    busy.value = true;
    try {
      const token = station.control.state.value?.token ?? "";
      await station.api.delete(
        `api/recordings/${encodeURIComponent(name)}`,
        token === "" ? {} : { "Control-Token": token },
      );
      dialog.current?.close();
    } catch (error) {
      refusal.value = error instanceof Error ? error.message : String(error);
      busy.value = false;
    }
  };
  return (
    <dialog class="panel delete-dialog" ref={dialog} aria-labelledby="delete-title" onClose={close}>
      <h2 id="delete-title">Delete this recording?</h2>
      <p>
        <strong>{name}</strong>
      </p>
      <p class="hint">{[whenText(recording), whatText(recording)].filter(Boolean).join("; ")}</p>
      <p>It is removed from the ground station's disk for good, for everybody.</p>
      {refusal.value !== "" && <p role="alert">Not deleted: {refusal.value}</p>}
      <div class="button-row">
        <button
          type="button"
          class="button"
          // What does no harm has the focus.
          autofocus
          onClick={() => dialog.current?.close()}
        >
          Keep it
        </button>
        <button
          type="button"
          class="button"
          aria-busy={busy.value}
          disabled={busy.value}
          onClick={() => void remove()}
        >
          Delete for good
        </button>
      </div>
    </dialog>
  );
}
