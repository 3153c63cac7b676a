import { expect, test } from "vitest";
import { addShortcuts, keysOf, shortcuts } from "./shortcuts";

const press = (
  key: string,
  held: Partial<Record<"ctrlKey" | "metaKey" | "altKey" | "shiftKey", boolean>> = {},
) => keysOf({ key, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...held });

test("a key press is named with its modifiers, whatever the keyboard", () => {
  expect(press("f")).toBe("f");
  expect(press("F", { shiftKey: true })).toBe("Shift+f");
  expect(press("?", { shiftKey: true })).toBe("?");
  expect(press("z", { metaKey: true })).toBe("Ctrl+z");
  expect(press("Z", { ctrlKey: true, shiftKey: true })).toBe("Ctrl+Shift+z");
  expect(press("Enter", { shiftKey: true })).toBe("Shift+Enter");
  expect(press(" ")).toBe("Space");
});

test("shortcuts go with the panel that brought them", () => {
  const shortcut = { keys: "x", label: "Does it", group: "Test", run: () => undefined };
  const takeAway = addShortcuts([shortcut]);
  expect(shortcuts.value).toContain(shortcut);
  takeAway();
  expect(shortcuts.value).not.toContain(shortcut);
});
