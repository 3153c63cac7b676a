import { useSignal } from "@preact/signals";
import { CommandButton } from "../panels/command_button";
import { kLeftOut, kLimitNames } from "../panels/flight_ahead";
import { Lamp } from "../panels/icons";
import { duration, kNone } from "../units/format";
import type { FormationEditor } from "./editor";
import type { FlownAhead, LimitReached, PreviewState } from "./preview";
import { pair, risksOf } from "./risks";
import type { EditSession } from "./session";
import { separation } from "./words";

interface ApplyProps {
  editor: FormationEditor;
  session: EditSession;
}

/** What Apply would do: flown ahead, with what speaks against it; and the button that does it. */
export function ApplyBar({ editor, session }: ApplyProps) {
  const { store } = editor.station;
  const overridden = useSignal<{ draft: object; risks: string } | null>(null);
  const draft = session.draft.value;
  const preview = editor.preview.state.value;
  const problems = editor.problems.value;
  const risks = risksOf(editor.conflicts.value, preview, (id) => store.callsign(id));
  const changed = session.changed.value;
  const waits = preview.kind === "waiting" || preview.kind === "running" || editor.proposing.value;
  // Those that were in sight, and no others that a later flight finds.
  const named = risks.map(({ text }) => text).join("\n");
  const accepted_risks = overridden.value?.draft === draft && overridden.value.risks === named;
  const ready = changed && problems.length === 0 && !waits && (risks.length === 0 || accepted_risks);
  return (
    <footer class="apply-bar">
      {changed && <PreviewFigures editor={editor} preview={preview} />}
      {problems.map((problem) => (
        <p key={problem} class="problem">
          {problem}
        </p>
      ))}
      {changed &&
        risks.map(({ text, level }) => (
          <p key={text} class="problem risk">
            <Lamp level={level} />
            {text}
          </p>
        ))}
      <p class="draft-state" role="status">
        <DraftState editor={editor} session={session} />
      </p>
      <div class="apply-buttons">
        {changed && risks.length > 0 && problems.length === 0 && (
          <label class="override">
            <input
              type="checkbox"
              checked={accepted_risks}
              onChange={(event) => {
                editor.preview.keep();
                overridden.value = event.currentTarget.checked ? { draft, risks: named } : null;
              }}
            />
            Apply all the same
          </label>
        )}
        <CommandButton
          class="button primary"
          label="Apply the formation"
          disabled={!ready}
          command={() => editor.apply()}
        >
          Apply
        </CommandButton>
        <button
          type="button"
          class="button"
          disabled={!changed}
          title={
            session.flown.value === null ? "Forgets this formation" : "Back to what is flown; can be undone"
          }
          onClick={() => {
            editor.discard();
          }}
        >
          Discard
        </button>
      </div>
    </footer>
  );
}

function DraftState({ editor, session }: ApplyProps) {
  if (session.changed.value) {
    return session.flown.value === null
      ? `Not flown yet: ${session.draft.value.slots.length} UAVs would form it.`
      : `Differs from what is flown: ${session.differences.value.join(", ")}.`;
  }
  return editor.accepted.value === session.draft.value
    ? "Accepted, and flown as applied."
    : "This is what is flown.";
}

function PreviewFigures({ editor, preview }: { editor: FormationEditor; preview: PreviewState }) {
  const { store } = editor.station;
  const now_ms = store.now_ms.value;
  if (preview.kind === "waiting" || preview.kind === "running") {
    const since_s = preview.kind === "running" ? Math.max(0, now_ms - preview.since_ms) / 1000 : 0;
    return (
      <div class="preview">
        <p class="preview-head">Flying it ahead…{since_s >= 1 ? ` ${duration(since_s)}` : ""}</p>
        <progress aria-label="Flying the draft ahead" />
      </div>
    );
  }
  if (preview.kind === "none") return null;
  if (preview.kind === "failed" || !preview.result.ok) {
    return (
      <div class="preview">
        <div class="preview-head">
          <span>Not flown ahead</span>
          <AgainButton editor={editor} title="Try to fly it ahead again" />
        </div>
      </div>
    );
  }
  const { result } = preview;
  const age_s = Math.floor(Math.max(0, now_ms - preview.at_ms) / 1000);
  return (
    <div class="preview">
      <div class="preview-head">
        <span title={`For ${duration(result.duration_s)}, from where the fleet was ${duration(age_s)} ago`}>
          Flown ahead {duration(age_s)} ago
        </span>
        <Scrubber editor={editor} result={result} />
        <AgainButton editor={editor} title="Fly it ahead again, from where the fleet is now" />
      </div>
      <Figures result={result} callsign={(id) => store.callsign(id)} />
      <p class="hint">{kLeftOut}</p>
    </div>
  );
}

function AgainButton({ editor, title }: { editor: FormationEditor; title: string }) {
  return (
    <button
      type="button"
      class="button quiet"
      aria-label="Fly it ahead again"
      title={title}
      onClick={() => {
        editor.preview.again();
      }}
    >
      ↻
    </button>
  );
}

interface FiguresProps {
  result: FlownAhead;
  callsign: (id: number) => string;
}

function Figures({ result, callsign }: FiguresProps) {
  const { least, nearest, settle_s, limits } = result;
  const pairs = nearest.map(
    ({ ids, horizontal_m, vertical_m, t_s }) =>
      `${pair(ids, callsign)}: ${separation(horizontal_m, vertical_m)}, +${Math.round(t_s)} s`,
  );
  return (
    <dl class="figures">
      <div>
        <dt>Least distance</dt>
        <dd class="least" title={pairs.join("\n")}>
          {least === null ? (
            kNone
          ) : (
            <>
              {separation(least.horizontal_m, least.vertical_m)}{" "}
              <span class="hint">
                {pair(least.ids, callsign)}, +{Math.round(least.t_s)} s
              </span>
            </>
          )}
        </dd>
      </div>
      <div>
        <dt>Settles</dt>
        <dd class="settles">
          {settle_s === null
            ? `not within ${Math.round(result.duration_s)} s`
            : `in ${Math.round(settle_s)} s`}
        </dd>
      </div>
      <div>
        <dt>At a limit</dt>
        <dd class="limits">
          <Limits limits={limits} callsign={callsign} />
        </dd>
      </div>
    </dl>
  );
}

function Limits({ limits, callsign }: { limits: readonly LimitReached[]; callsign: (id: number) => string }) {
  const longest = [...limits].sort((a, b) => b.seconds - a.seconds);
  const text = ({ vehicle_id, limit, t_s, seconds }: LimitReached) =>
    `${callsign(vehicle_id)}: ${kLimitNames[limit] ?? limit}, ${Math.max(1, Math.round(seconds))} s from +${Math.round(t_s)} s`;
  const [first, ...others] = longest;
  if (first === undefined) return "nobody";
  return (
    <span title={longest.map(text).join("\n")}>
      {text(first)}
      {others.length > 0 && <span class="hint"> and {others.length} more</span>}
    </span>
  );
}

/** Where everybody would be, at any time of the preview, is drawn on the map. */
function Scrubber({ editor, result }: { editor: FormationEditor; result: FlownAhead }) {
  const at_s = Math.min(editor.looked_at_s.value, result.duration_s);
  return (
    <label class="scrubber">
      <input
        type="range"
        min={0}
        max={Math.ceil(result.duration_s)}
        step={1}
        value={at_s}
        aria-label="Time that is shown on the map"
        aria-valuetext={`${Math.round(at_s)} seconds ahead`}
        onInput={(event) => {
          editor.looked_at_s.value = Number(event.currentTarget.value);
        }}
      />
      <output>+{Math.round(at_s)} s</output>
    </label>
  );
}
