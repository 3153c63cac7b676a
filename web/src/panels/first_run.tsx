import { useSignal } from "@preact/signals";
import { replay } from "../state/replay";
import type { Store } from "../state/store";
import { kNodes, missingFor, nodeStates, type NodeState } from "./nodes";

const kStart = "scripts/run";
/** Nodes send a heartbeat a second: one that has not been heard for so long is not there. */
const kPatience_ms = 4000;

/** While there is no fleet, or nobody to fly or watch it: what the page waits for, and the commands that start it. */
export function FirstRun({ store }: { store: Store }) {
  const hello = store.hello.value;
  if (store.connection.value.kind !== "open" || hello === null || replay.value?.kind === "log") return null;
  const nodes = nodeStates(store.heartbeats.value, store.silent_nodes.value);
  if (store.roster.value !== null) return <Incomplete store={store} nodes={nodes} />;
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
      <ul class="nodes" aria-label="Programs">
        {nodes.map((node) => (
          <NodeLine key={node.name} node={node} />
        ))}
      </ul>
      <p class="hint">They must use the same LCM URL as the bridge (--lcm-url, or LCM_DEFAULT_URL).</p>
    </section>
  );
}

function NodeLine({ node: { name, state } }: { node: NodeState }) {
  return (
    <li>
      <div class="node-head">
        <span class="node-name">{name}</span>
        <span class="hint">{kNodes[name].does}</span>
        <span class={`node-state ${state}`}>
          {state === "heard" ? "✓ heard" : state === "silent" ? "fallen silent" : "not heard"}
        </span>
      </div>
      {state !== "heard" && <CommandLine text={kNodes[name].command} />}
    </li>
  );
}

/** A fleet flies, but a program that was never heard is missing. (One that has fallen silent is the banner's business.) */
function Incomplete({ store, nodes }: { store: Store; nodes: readonly NodeState[] }) {
  const since_ms = useSignal(store.now_ms.value);
  const dismissed = useSignal(false);
  const missing = missingFor(nodes);
  if (dismissed.value || missing.length === 0 || store.now_ms.value - since_ms.value < kPatience_ms)
    return null;
  return (
    <section class="panel incomplete" aria-labelledby="incomplete-title">
      <h2 id="incomplete-title">Not all of the ground station runs</h2>
      {missing.map((name) => (
        <div key={name} class="missing">
          <p>
            <strong>{name}</strong> has not been heard: {kNodes[name].without}
          </p>
          <CommandLine text={kNodes[name].command} />
        </div>
      ))}
      <button
        type="button"
        class="button quiet"
        onClick={() => {
          dismissed.value = true;
        }}
      >
        Dismiss
      </button>
    </section>
  );
}

function CommandLine({ text }: { text: string }) {
  const copied = useSignal(false);
  const copy = () => {
    // Browsers allow it only to pages of this machine or over TLS; the text can be selected by hand just as well.
    void navigator.clipboard?.writeText(text).then(
      () => {
        copied.value = true;
      },
      () => undefined,
    );
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
