import { useSignal, type Signal } from "@preact/signals";
import { useCallback, useEffect, useRef } from "preact/hooks";
import type { Api } from "../link/api";
import type { RecordingList } from "../link/recording_messages";

/** Recordings come and grow; while some are being read, there is more to see. */
const kAskAgain_ms = 5000;
const kWhileReading_ms = 700;

export interface Recordings {
  /** Null until it has come. */
  list: RecordingList | null;
  /** Why the newest question had no answer; "". */
  problem: string;
  /** Asks at once. */
  ask: () => void;
}

/** The bridge's list, kept up to date for as long as somebody looks. */
export function useRecordings(api: Api): Recordings {
  const list = useSignal<RecordingList | null>(null);
  const problem = useSignal("");
  const asked = useRef<AbortController | null>(null);
  const ask = useCallback(() => {
    asked.current?.abort();
    asked.current = new AbortController();
    void keepAsking(api, list, problem, asked.current.signal);
  }, [api, list, problem]);
  useEffect(() => {
    ask();
    return () => asked.current?.abort();
  }, [ask]);
  return { list: list.value, problem: problem.value, ask };
}

async function keepAsking(
  api: Api,
  list: Signal<RecordingList | null>,
  problem: Signal<string>,
  abort: AbortSignal,
): Promise<void> {
  while (!abort.aborted) {
    try {
      list.value = await api.getJson<RecordingList>("api/recordings", abort);
      problem.value = "";
    } catch (error) {
      if (abort.aborted) return;
      problem.value = error instanceof Error ? error.message : String(error);
    }
    const reading = list.value?.recordings.some((one) => !one.indexed && one.problem === "") ?? false;
    await pause(reading ? kWhileReading_ms : kAskAgain_ms, abort);
  }
}

function pause(duration_ms: number, abort: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const end = () => {
      clearTimeout(timer);
      abort.removeEventListener("abort", end);
      resolve();
    };
    const timer = setTimeout(end, duration_ms);
    abort.addEventListener("abort", end);
  });
}
