import { expect, test } from "vitest";
import type { Formation } from "../link/messages";
import type { Station } from "../shell/station";
import { Store } from "../state/store";
import { bodyOf, newDraft, withSpacing } from "./draft";
import { FormationEditor } from "./editor";

const message = (id: number): Formation => ({
  type: "formation",
  utime: 1,
  ...bodyOf(newDraft(id, [10 * id + 1, 10 * id + 2, 10 * id + 3])),
});

function begin() {
  const store = new Store(() => undefined);
  const editor = new FormationEditor({ store, api: {} } as unknown as Station);
  const flies = (...ids: number[]) => {
    store.formations.value = new Map(ids.map((id) => [id, message(id)]));
  };
  return { editor, flies };
}

test("the first formation that is flown is open until another one is chosen", () => {
  const { editor, flies } = begin();
  expect(editor.chosen_id.value).toBeNull();
  flies(2);
  expect(editor.chosen_id.value).toBe(2);
  flies(1, 2);
  expect(editor.chosen_id.value).toBe(2);
});

test("the chosen one is open again after all were gone, in whatever order they come back", () => {
  const { editor, flies } = begin();
  flies(1, 2);
  editor.choose(2);
  flies();
  flies(1);
  expect(editor.chosen_id.value).toBe(1);
  flies(1, 2);
  expect(editor.chosen_id.value).toBe(2);
});

test("nobody is taken away from what he has begun to change", () => {
  const { editor, flies } = begin();
  flies(1, 2);
  editor.choose(2);
  flies(1);
  const session = editor.session.value;
  session?.change(withSpacing(session.draft.value, 400), "spacing");
  flies(1, 2);
  expect(editor.chosen_id.value).toBe(1);
});
