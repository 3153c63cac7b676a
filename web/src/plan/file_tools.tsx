import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { download } from "../shell/download";
import type { Station } from "../shell/station";
import { PathFileError } from "./path_file";
import { kFileKinds, kLargestFile_bytes, readPathFile, writePathFile, type FileKind } from "./path_files";
import type { Planner } from "./planner";
import { showPath } from "./show_path";

/** What has become of a file. */
interface Report {
  file: string;
  /** Empty: it was taken without a remark. */
  lines: readonly string[];
  refused: boolean;
}

interface FileToolsProps {
  station: Station;
  planner: Planner;
}

/** Paths from and into files; a file can also be dropped anywhere on the page. */
export function FileTools({ station, planner }: FileToolsProps) {
  const report = useSignal<Report | null>(null);
  const open = useSignal(false);
  const picker = useRef<HTMLInputElement>(null);
  const frame = station.map.value?.frame() ?? null;
  const plan = planner.draft.value?.plan.value;

  const take = useRef<(file: File) => Promise<void>>(() => Promise.resolve());
  take.current = async (file) => {
    report.value = await readInto(planner, station, file);
    open.value = true;
  };
  useEffect(() => {
    // Without this, the browser would leave the page for the file.
    const over = (event: DragEvent) => {
      if (event.dataTransfer?.types.includes("Files")) event.preventDefault();
    };
    const drop = (event: DragEvent) => {
      const file = event.dataTransfer?.files[0];
      if (file === undefined) return;
      event.preventDefault();
      void take.current(file);
    };
    document.addEventListener("dragover", over);
    document.addEventListener("drop", drop);
    return () => {
      document.removeEventListener("dragover", over);
      document.removeEventListener("drop", drop);
    };
  }, []);

  const save = (kind: FileKind, mime: string) => {
    if (frame === null || plan === undefined) return;
    const geometry = planner.preview.geometry.peek();
    const line = geometry?.plan === plan ? geometry.preview.line : [];
    const name = planner.formation_name.value;
    const text = writePathFile(kind, plan, line, frame, name);
    download(`${name}.${kind}`, new Blob([text], { type: mime }));
  };
  return (
    <details
      class="plan-details"
      open={open.value}
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary>Files: open and save</summary>
      <div class="plan-fields">
        <button
          type="button"
          class="button"
          disabled={frame === null}
          onClick={() => picker.current?.click()}
        >
          Open a file…
        </button>
        <input
          ref={picker}
          type="file"
          class="visually-hidden"
          tabIndex={-1}
          aria-label="File with a path"
          accept=".geojson,.json,.kml,.plan"
          onChange={(event) => {
            const file = event.currentTarget.files?.[0];
            if (file !== undefined) void take.current(file);
            event.currentTarget.value = "";
          }}
        />
        <span class="hint">or drop it here: GeoJSON, KML, QGroundControl .plan</span>
      </div>
      <div class="plan-fields">
        <span>Save as</span>
        {kFileKinds.map(({ kind, name, mime, altitudes }) => (
          <button
            key={kind}
            type="button"
            class="button"
            title={`${name}, WGS-84. ${altitudes}`}
            disabled={frame === null || plan === undefined || plan.waypoints.length === 0}
            onClick={() => {
              save(kind, mime);
            }}
          >
            {name}
          </button>
        ))}
      </div>
      {report.value !== null && (
        <div class="plan-note" role={report.value.refused ? "alert" : "status"}>
          <p>
            <b>{report.value.file}</b>{" "}
            {report.value.refused ? "can't be taken." : "is on the map as a draft."}
          </p>
          {report.value.lines.map((line) => (
            <p key={line}>{line}</p>
          ))}
          <button
            type="button"
            class="button quiet"
            aria-label="Dismiss"
            onClick={() => {
              report.value = null;
            }}
          >
            ✕
          </button>
        </div>
      )}
    </details>
  );
}

async function readInto(planner: Planner, station: Station, file: File): Promise<Report> {
  const refuse = (line: string): Report => ({ file: file.name, lines: [line], refused: true });
  const frame = station.map.peek()?.frame() ?? null;
  const draft = planner.draft.peek();
  if (frame === null || draft === null) return refuse("No formation is known yet to fly it.");
  if (file.size > kLargestFile_bytes) return refuse(`It is larger than ${kLargestFile_bytes / 1e6} MB.`);
  try {
    const { closed, waypoints, notes } = readPathFile(await file.text(), frame, planner.defaults());
    draft.replace({ closed, waypoints }, `open ${file.name}`);
    showPath(station.map.peek(), draft.plan.peek());
    return { file: file.name, lines: notes, refused: false };
  } catch (error) {
    return refuse(error instanceof PathFileError ? error.message : `It can't be read: ${String(error)}`);
  }
}
