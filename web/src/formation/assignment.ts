/**
 * Who flies to which place: the least sum of straight distances. Two straight ways that cross could be exchanged for two that
 * are shorter together (triangle inequality), so none cross.
 */
import { munkres } from "munkres";

/** x, y, z of each point, one after the other [m]. */
export type Points = Float64Array;

/**
 * Ways along one line have the same sum whoever flies which; a little of the squares prefers two short ways to one long and
 * one of none, so that nobody overtakes.
 */
const kSquareShare = 1e-6;

/** For each of `from`, which of as many `to` it gets. */
export function assign(from: Points, to: Points): number[] {
  const count = from.length / 3;
  if (to.length !== from.length) throw new Error("as many places as there are to go to them");
  const costs = Array.from({ length: count }, (_, i) =>
    Float64Array.from({ length: count }, (_none, j) =>
      Math.hypot(from[3 * i] - to[3 * j], from[3 * i + 1] - to[3 * j + 1], from[3 * i + 2] - to[3 * j + 2]),
    ),
  );
  const longest_m = costs.reduce((most, row) => row.reduce((a, b) => Math.max(a, b), most), 1);
  for (const row of costs) {
    row.forEach((distance_m, j) => {
      row[j] = distance_m * (1 + (kSquareShare * distance_m) / longest_m);
    });
  }
  const places: number[] = new Array<number>(count).fill(-1);
  for (const [i, j] of munkres(costs)) places[i] = j;
  return places;
}

/** As `assign`, elsewhere: a thousand take a second. An answer that nobody waits for any more is given up by `abort`. */
export function assignInWorker(from: Points, to: Points, abort: AbortSignal): Promise<number[]> {
  return new Promise((resolve, reject) => {
    const worker = new Worker(new URL("./assignment_worker.ts", import.meta.url), { type: "module" });
    const end = () => {
      worker.terminate();
    };
    abort.addEventListener("abort", () => {
      end();
      reject(new DOMException("Nobody waits any more.", "AbortError"));
    });
    worker.onmessage = (event: MessageEvent<number[]>) => {
      end();
      resolve(event.data);
    };
    worker.onerror = (event) => {
      end();
      reject(new Error(event.message || "The proposal of places failed."));
    };
    worker.postMessage([from, to]);
  });
}
