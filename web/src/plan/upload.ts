/** Sends a plan to the bus, and reads back what is flown then. */
import type { ReadonlySignal } from "@preact/signals";
import type { Path } from "../link/messages";
import { differences } from "./compare";
import type { PathPlan } from "./path_plan";

/** What has become of a plan that was sent. */
export type Upload =
  | { kind: "none" }
  | { kind: "reading back" }
  | { kind: "flown"; path_revision: number }
  | { kind: "differs"; differences: string[] }
  | { kind: "silent" };

type Paths = ReadonlySignal<ReadonlyMap<number, Path>>;

const kReadBack_ms = 5000;

/** Compares what was sent with the path that the bus tells of next. */
export async function readBack(
  paths: Paths,
  formation_id: number,
  sent: PathPlan,
  revision_before: number,
): Promise<Upload> {
  const path = await newerPath(paths, formation_id, revision_before);
  if (path === null) return { kind: "silent" };
  const found = differences(sent, path);
  return found.length === 0
    ? { kind: "flown", path_revision: path.path_revision }
    : { kind: "differs", differences: found };
}

/** The formation's path once its revision has risen; null when it does not. */
function newerPath(paths: Paths, formation_id: number, revision_before: number): Promise<Path | null> {
  return new Promise((resolve) => {
    let unsubscribe = () => {};
    const settle = (path: Path | null) => {
      clearTimeout(timer);
      resolve(path);
      // Not yet known when the path is there already.
      queueMicrotask(() => {
        unsubscribe();
      });
    };
    const timer = setTimeout(() => {
      settle(null);
    }, kReadBack_ms);
    unsubscribe = paths.subscribe((known) => {
      const path = known.get(formation_id);
      if (path !== undefined && path.path_revision > revision_before) settle(path);
    });
  });
}
