import { signal } from "@preact/signals";
import { describe, expect, test } from "vitest";
import type { Formation } from "../link/messages";
import { bodyOf, draftOf, newDraft, withShape, withSpacing, type Draft } from "./draft";
import { EditSession } from "./session";

const message = (draft: Draft): Formation => ({ type: "formation", utime: 1, ...bodyOf(draft) });
const triangle = newDraft(1, [1, 2, 3]);

function begin() {
  const flown = signal<Formation | null>(message(triangle));
  const session = new EditSession(draftOf(message(triangle)), flown);
  return { flown, session };
}

describe("an edit session", () => {
  test("follows what is flown while nothing is edited", () => {
    const { flown, session } = begin();
    flown.value = message(withShape(triangle, "column"));
    expect(session.draft.value.shape).toBe("column");
    expect(session.changed.value).toBe(false);
    expect(session.history.undo_label.value).toBe(null);
  });

  test("says what differs from what is flown, until it is applied", () => {
    const { flown, session } = begin();
    const draft = withSpacing(session.draft.value, 400);
    session.change(draft, "spacing");
    expect(session.differences.value).toEqual(["spacing", "2 places"]);
    flown.value = { ...message(draft), utime: 2 };
    expect(session.changed.value).toBe(false);
    expect(session.overtaken.value).toEqual([]);
    session.history.undo();
    expect(session.draft.value.spacing_m).toBe(500);
  });

  test("keeps the draft when another operator changes the formation, and says so", () => {
    const { flown, session } = begin();
    session.change(withSpacing(session.draft.value, 400), "spacing");
    flown.value = message(withShape(triangle, "column"));
    expect(session.draft.value).toMatchObject({ shape: "triangle", spacing_m: 400 });
    expect(session.overtaken.value).toEqual(["shape", "2 places"]);
    session.keepMine();
    expect(session.overtaken.value).toEqual([]);
    expect(session.draft.value.spacing_m).toBe(400);
    flown.value = message(withShape(triangle, "vee"));
    session.takeFlown();
    expect(session.draft.value.shape).toBe("vee");
    expect(session.changed.value).toBe(false);
    session.history.undo();
    expect(session.draft.value).toMatchObject({ shape: "triangle", spacing_m: 400 });
  });

  test("a formation that begins to hold has not been changed", () => {
    const { flown, session } = begin();
    session.change(withSpacing(session.draft.value, 400), "spacing");
    flown.value = { ...message(triangle), hold: true };
    expect(session.overtaken.value).toEqual([]);
  });

  test("keeps the draft of a formation that was removed", () => {
    const { flown, session } = begin();
    flown.value = null;
    expect(session.removed).toBe(true);
    expect(session.differences.value).toEqual(["not flown yet"]);
    expect(session.draft.value.slots).toHaveLength(3);
  });
});
