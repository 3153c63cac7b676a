import { expect, test } from "vitest";
import { Store } from "../state/store";
import { clickRow } from "./select_rows";

const kShown = [30, 10, 20, 40];
const plain = { shift: false, ctrl: false };

test("a click selects one, again none; Ctrl adds and takes out; Shift takes the range as shown", () => {
  const store = new Store(() => undefined);
  const selected = () => [...store.selection.value];
  clickRow(store, kShown, 10, null, plain);
  expect(selected()).toEqual([10]);
  clickRow(store, kShown, 40, 10, { shift: true, ctrl: false });
  expect(selected()).toEqual([10, 20, 40]);
  clickRow(store, kShown, 30, 20, { shift: true, ctrl: false });
  expect(selected()).toEqual([20, 10, 30]);
  clickRow(store, kShown, 10, 20, { shift: false, ctrl: true });
  expect(selected()).toEqual([20, 30]);
  clickRow(store, kShown, 40, null, plain);
  clickRow(store, kShown, 40, null, plain);
  expect(selected()).toEqual([]);
});

test("Shift without a row to start from selects the one that was clicked", () => {
  const store = new Store(() => undefined);
  clickRow(store, kShown, 20, 99, { shift: true, ctrl: false });
  expect([...store.selection.value]).toEqual([20]);
});
