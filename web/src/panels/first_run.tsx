import { useSignal } from "@preact/signals";
import type { Store } from "../state/store";

const kStart = "scripts/run";
const kProcesses = [
  "build/bin/fleet-simulator --scenario scripts/scenarios/triangle.json",
  "build/bin/formation-controller --scenario scripts/scenarios/triangle.json",
  "build/bin/collision-monitor --scenario scripts/scenarios/triangle.json",
];

/** Before any fleet was heard: what the page waits for, and how to start one. */
export function FirstRun({ store }: { store: Store }) {
  const hello = store.hello.value;
  if (store.roster.value !== null || store.connection.value.kind !== "open" || hello === null) return null;
  return (
    <section class="panel first-run" aria-labelledby="first-run-title">
      <h2 id="first-run-title">Waiting for a fleet</h2>
      <p>
        web-bridge {hello.version} listens on <code>{hello.lcm_url}</code>, and has heard no FLEET_ROSTER
        there yet. The map fills by itself as soon as one comes.
      </p>
      <p>Start everything with the paper's triangle:</p>
      <CommandLine text={kStart} />
      <p>or only what is missing beside this bridge:</p>
      {kProcesses.map((text) => (
        <CommandLine key={text} text={text} />
      ))}
      <p class="hint">They must use the same LCM URL as the bridge (--lcm-url, or LCM_DEFAULT_URL).</p>
    </section>
  );
}

function CommandLine({ text }: { text: string }) {
  const copied = useSignal(false);
  const copy = () => {
    // Browsers allow it only to pages of this machine or over TLS; the text can be selected by hand just as well.
    void navigator.clipboard?.writeText(text).then(() => {
      copied.value = true;
    });
  };
  return (
    <div class="command-line">
      <code>{text}</code>
      <button type="button" class="button quiet" onClick={copy} aria-label={`Copy: ${text}`}>
        {copied.value ? "Copied" : "Copy"}
      </button>
    </div>
  );
}
