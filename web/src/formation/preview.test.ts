import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { ApiError } from "../link/api";
import { newDraft, withSpacing } from "./draft";
import { kOld_ms, Preview, type FormationPreview } from "./preview";

const kResult: FormationPreview = {
  ok: true,
  duration_s: 60,
  complete: true,
  least: null,
  nearest: [],
  settle_s: 20,
  limits: [],
  tracks: [],
};
const triangle = newDraft(1, [1, 2, 3]);

/** A bridge that answers when the test says so. */
function bridge() {
  const asked: { spacing_m: number; aborted: () => boolean; answer: (result: FormationPreview) => void }[] =
    [];
  const failing = { with: null as ApiError | null };
  const api = {
    postJson: <T>(_path: string, body: unknown, abort?: AbortSignal): Promise<T> => {
      if (failing.with !== null) return Promise.reject(failing.with);
      return new Promise((resolve) => {
        asked.push({
          spacing_m: (body as { formation: { spacing_m: number } }).formation.spacing_m,
          aborted: () => abort?.aborted ?? false,
          answer: (result) => {
            resolve(result as T);
          },
        });
      });
    },
  };
  return { asked, failing, preview: new Preview(api) };
}

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

test("only the last of several quick edits is flown", async () => {
  const { asked, preview } = bridge();
  for (const spacing_m of [400, 410, 420]) {
    preview.want(withSpacing(triangle, spacing_m));
    await vi.advanceTimersByTimeAsync(200);
    expect(preview.state.value.kind).toBe("waiting");
  }
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked.map(({ spacing_m }) => spacing_m)).toEqual([420]);
  expect(preview.state.value.kind).toBe("running");
  asked[0]?.answer(kResult);
  await vi.advanceTimersByTimeAsync(0);
  expect(preview.state.value).toMatchObject({ kind: "done", result: kResult });
});

test("an answer about an earlier draft is not shown, and nobody goes on working on it", async () => {
  const { asked, preview } = bridge();
  preview.want(withSpacing(triangle, 400));
  await vi.advanceTimersByTimeAsync(1000);
  preview.want(withSpacing(triangle, 300));
  expect(asked[0]?.aborted()).toBe(true);
  asked[0]?.answer(kResult);
  await vi.advanceTimersByTimeAsync(100);
  expect(preview.state.value.kind).toBe("waiting");
});

test("the same draft is flown once, and again when that is asked for", async () => {
  const { asked, preview } = bridge();
  preview.want(triangle);
  await vi.advanceTimersByTimeAsync(1000);
  preview.want(triangle);
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toHaveLength(1);
  preview.again();
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toHaveLength(2);
});

test("a bridge that can't is told of", async () => {
  const { failing, preview } = bridge();
  failing.with = new ApiError("web-bridge answered 404.");
  preview.want(triangle);
  await vi.advanceTimersByTimeAsync(1000);
  expect(preview.state.value).toEqual({ kind: "failed", reason: "web-bridge answered 404." });
});

test("what is old is flown anew, and stays in sight meanwhile", async () => {
  const { asked, preview } = bridge();
  preview.want(triangle);
  await vi.advanceTimersByTimeAsync(1000);
  asked[0]?.answer(kResult);
  await vi.advanceTimersByTimeAsync(kOld_ms + 1000);
  expect(asked).toHaveLength(2);
  expect(preview.state.value).toMatchObject({ kind: "done", result: kResult });
  asked[1]?.answer({ ...kResult, settle_s: 21 });
  await vi.advanceTimersByTimeAsync(0);
  expect(preview.state.value).toMatchObject({ kind: "done", result: { settle_s: 21 } });
  preview.keep();
  await vi.advanceTimersByTimeAsync(10 * kOld_ms);
  expect(asked).toHaveLength(2);
});
