/** The programs of a ground station beside its bridge: what each is for, and which of them have been heard. */

interface NodeInfo {
  does: string;
  /** What is amiss without it while a fleet flies. */
  without: string;
  command: string;
}

export const kNodes = {
  "fleet-simulator": {
    does: "flies the UAVs, where no real ones are",
    without: "",
    command: "build/bin/fleet-simulator --scenario triangle",
  },
  "formation-controller": {
    does: "flies the formations",
    without: "nobody commands the UAVs, and formations and paths cannot be set.",
    command: "build/bin/formation-controller --scenario triangle",
  },
  "collision-monitor": {
    does: "warns of collisions and lost links",
    without: "there are no warnings, and lost links are not found.",
    command: "build/bin/collision-monitor --scenario triangle",
  },
} as const satisfies Readonly<Record<string, NodeInfo>>;

export type NodeName = keyof typeof kNodes;

export interface NodeState {
  name: NodeName;
  state: "heard" | "silent" | "never";
}

export function nodeStates(
  heartbeats: ReadonlyMap<string, unknown>,
  silent: readonly string[],
): readonly NodeState[] {
  return (Object.keys(kNodes) as NodeName[]).map((name) => ({
    name,
    state: silent.includes(name) ? "silent" : heartbeats.has(name) ? "heard" : "never",
  }));
}

/** Those that a fleet which is there cannot do without. The fleet itself may be real. */
export function missingFor(nodes: readonly NodeState[]): NodeName[] {
  return nodes
    .filter(({ name, state }) => state === "never" && kNodes[name].without !== "")
    .map(({ name }) => name);
}
