import { useEffect } from "preact/hooks";
import type { PanelProps } from "../shell/panel_props";
import { CommandButton } from "../panels/command_button";
import { useShortcuts } from "../shell/shortcuts";
import { ApplyBar } from "./apply_bar";
import { withMembers } from "./draft";
import { editorOf, type FormationEditor } from "./editor";
import { GhostLayer } from "./ghost_layer";
import { nameOf } from "./hold";
import { LawForm, LimitsForm } from "./law_form";
import type { EditSession } from "./session";
import { ShapeForm } from "./shape_form";
import { SlotCanvas } from "./slot_canvas";
import { SlotTable } from "./slot_table";
import { flownInWords } from "./words";
import "./formation.css";
import "./law_and_apply.css";

/** The paper's formation setting: a draft is edited, flown ahead, and applied. */
export function FormationPanel({ station }: PanelProps) {
  const editor = editorOf(station);
  useOpen(editor);
  const session = editor.session.value;
  const undo = () => session?.history.undo();
  const redo = () => session?.history.redo();
  useShortcuts([
    { keys: "Ctrl+z", label: "Undo", group: "Formation", run: () => undo(), repeats: true },
    { keys: "Ctrl+Shift+z", label: "Redo", group: "Formation", run: () => redo(), repeats: true },
  ]);
  return (
    <div class="formation-panel">
      <div class="formation-scroll">
        <Chooser editor={editor} session={session} />
        {session === null ? (
          <p class="empty">
            No formation is flown. Select UAVs on the map or in the table, then press <b>New</b>.
          </p>
        ) : (
          <>
            <Notices session={session} />
            <ShapeForm editor={editor} session={session} />
            <SlotCanvas key={editor.chosen_id.value} editor={editor} session={session} />
            <Places editor={editor} session={session} />
            <LimitsForm session={session} />
            <LawForm session={session} />
          </>
        )}
      </div>
      {session !== null && <ApplyBar key={editor.chosen_id.value} editor={editor} session={session} />}
    </div>
  );
}

/** While the panel is open, drafts are drawn on the map and flown ahead. */
function useOpen(editor: FormationEditor): void {
  const map = editor.station.map.value;
  useEffect(() => {
    editor.open.value = true;
    return () => {
      editor.open.value = false;
    };
  }, [editor]);
  useEffect(() => {
    if (map === null) return;
    const layer = new GhostLayer(map, editor);
    return () => {
      layer.remove();
    };
  }, [map, editor]);
}

interface PartProps {
  editor: FormationEditor;
  session: EditSession;
}

function Chooser({ editor, session }: { editor: FormationEditor; session: EditSession | null }) {
  const { store, commands } = editor.station;
  const formations = store.formations.value;
  const sessions = editor.sessions.value;
  const ids = [...new Set([...formations.keys(), ...sessions.keys()])].sort((a, b) => a - b);
  const selected = [...store.selection.value];
  const nameOfId = (id: number) => {
    const flown = formations.get(id);
    const draft = sessions.get(id);
    const name = flown === undefined ? (draft?.draft.value.name ?? "") : nameOf(flown);
    return draft?.changed.value === true ? `${name} ✎` : name;
  };
  const flown = session?.flown.value ?? null;
  const { undo_label, redo_label } = session?.history ?? {};
  return (
    <header class="chooser">
      <div class="chooser-row">
        <select
          aria-label="Formation"
          title="Formation that is edited"
          value={String(editor.chosen_id.value ?? "")}
          disabled={ids.length === 0}
          onChange={(event) => {
            editor.choose(Number(event.currentTarget.value));
          }}
        >
          {ids.map((id) => (
            <option key={id} value={String(id)}>
              {nameOfId(id)}
            </option>
          ))}
        </select>
        <button
          type="button"
          class="button"
          disabled={selected.length === 0}
          title={
            selected.length === 0
              ? "Select UAVs on the map or in the table first"
              : `A new formation of the ${selected.length} selected UAVs`
          }
          onClick={() => {
            editor.create(selected);
          }}
        >
          New
        </button>
        <button
          type="button"
          class="button square"
          aria-label={undo_label?.value ? `Undo: ${undo_label.value}` : "Undo"}
          title={undo_label?.value ? `Undo: ${undo_label.value} (Ctrl+Z)` : "Nothing to undo"}
          disabled={!undo_label?.value}
          onClick={() => session?.history.undo()}
        >
          ↶
        </button>
        <button
          type="button"
          class="button square"
          aria-label={redo_label?.value ? `Redo: ${redo_label.value}` : "Redo"}
          title={redo_label?.value ? `Redo: ${redo_label.value} (Ctrl+Shift+Z)` : "Nothing to redo"}
          disabled={!redo_label?.value}
          onClick={() => session?.history.redo()}
        >
          ↷
        </button>
      </div>
      {session !== null && (
        <div class="chooser-row">
          <p class="flown">{flown === null ? "Not flown" : `Flown: ${flownInWords(flown)}`}</p>
          {flown !== null && (
            <CommandButton
              class="button quiet"
              label={`Remove ${nameOf(flown)}: its UAVs hold course and altitude`}
              command={() =>
                commands.request("CMD_FORMATION", {
                  action: "remove",
                  formation: { formation_id: flown.formation_id },
                })
              }
            >
              Remove
            </CommandButton>
          )}
        </div>
      )}
    </header>
  );
}

/** What happened on the bus while this draft was edited. */
function Notices({ session }: { session: EditSession }) {
  const overtaken = session.overtaken.value;
  if (session.flown.value === null && session.removed) {
    return (
      <p class="formation-notice" role="status">
        It is flown no more. Apply makes it anew.
      </p>
    );
  }
  if (overtaken.length === 0) return null;
  return (
    <div class="formation-notice" role="alert">
      <p>What is flown has changed since you began: {overtaken.join(", ")}. Your draft is still here.</p>
      <div class="notice-buttons">
        <button
          type="button"
          class="button"
          onClick={() => {
            session.keepMine();
          }}
        >
          Keep my draft
        </button>
        <button
          type="button"
          class="button"
          onClick={() => {
            session.takeFlown();
          }}
        >
          Take what is flown
        </button>
      </div>
    </div>
  );
}

/** Who flies where. */
function Places({ editor, session }: PartProps) {
  const { store } = editor.station;
  const draft = session.draft.value;
  const members = new Set(draft.slots.map(({ vehicle_id }) => vehicle_id));
  const others = [...store.selection.value].filter((id) => !members.has(id));
  return (
    <section aria-label="Places">
      <div class="places-head">
        <h3>Places</h3>
        <span class="hint">
          {editor.proposing.value ? "proposing…" : draft.by_hand ? "by hand" : "without crossing ways"}
        </span>
        <button
          type="button"
          class="button"
          title="Who flies where, so that no ways cross"
          disabled={editor.proposing.value || draft.slots.length < 2}
          onClick={() => void editor.propose("propose places")}
        >
          Propose
        </button>
        <button
          type="button"
          class="button"
          title={
            others.length === 0
              ? "Select UAVs that are not in the formation first"
              : `Add the ${others.length} selected UAVs`
          }
          disabled={others.length === 0}
          onClick={() => {
            editor.reshape(withMembers(draft, others), "add UAVs");
          }}
        >
          Add
        </button>
      </div>
      {editor.proposal_problem.value !== "" && <p class="problem">{editor.proposal_problem.value}</p>}
      <SlotTable editor={editor} session={session} />
    </section>
  );
}
