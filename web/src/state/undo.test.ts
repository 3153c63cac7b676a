import { describe, expect, test } from "vitest";
import { History } from "./undo";

const letters = (...texts: string[]) => {
  const history = new History("");
  for (const text of texts) history.change(text, `type ${text}`);
  return history;
};

describe("History", () => {
  test("goes back and forth step by step, and says what each step would do", () => {
    const history = letters("a", "ab");
    expect(history.undo_label.value).toBe("type ab");
    history.undo();
    expect(history.present.value).toBe("a");
    expect([history.undo_label.value, history.redo_label.value]).toEqual(["type a", "type ab"]);
    history.undo();
    expect([history.present.value, history.undo_label.value]).toEqual(["", null]);
    history.redo();
    history.redo();
    expect([history.present.value, history.redo_label.value]).toEqual(["ab", null]);
  });

  test("does nothing where there is nothing to undo or redo", () => {
    const history = letters("a");
    history.redo();
    history.undo();
    history.undo();
    expect(history.present.value).toBe("");
  });

  test("forgets what was undone once something else is done", () => {
    const history = letters("a", "ab");
    history.undo();
    history.change("ac", "type ac");
    expect(history.redo_label.value).toBe(null);
    history.undo();
    expect(history.present.value).toBe("a");
  });

  test("takes a gesture back as one step, and two gestures as two", () => {
    const history = letters("a");
    for (const text of ["b", "c", "d"]) history.change(text, "drag", "drag 1");
    history.endGesture();
    for (const text of ["e", "f"]) history.change(text, "drag", "drag 1");
    history.undo();
    expect(history.present.value).toBe("d");
    history.undo();
    expect(history.present.value).toBe("a");
  });

  test("begins a new step when a gesture goes on after an undo", () => {
    const history = letters("a");
    history.change("b", "drag", "drag 1");
    history.undo();
    history.change("c", "drag", "drag 1");
    history.undo();
    expect(history.present.value).toBe("a");
  });

  test("makes no step of a change that changes nothing", () => {
    const history = letters("a");
    history.change("a", "nothing");
    expect(history.undo_label.value).toBe("type a");
  });

  test("begins anew without a way back", () => {
    const history = letters("a", "ab");
    history.undo();
    history.reset("z");
    expect([history.present.value, history.undo_label.value, history.redo_label.value]).toEqual([
      "z",
      null,
      null,
    ]);
  });
});
