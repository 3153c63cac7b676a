import { signal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { Icon } from "./icon";
import { shortcuts, useShortcuts } from "./shortcuts";

export const help_open = signal(false);

/** All that the keyboard does, now. */
export function Help() {
  const dialog = useRef<HTMLDialogElement>(null);
  useShortcuts([
    {
      keys: "?",
      label: "This help",
      group: "Page",
      over_dialogs: true,
      run: () => {
        help_open.value = !help_open.value;
      },
    },
  ]);
  const open = help_open.value;
  useLayoutEffect(() => {
    if (open) dialog.current?.showModal();
    else dialog.current?.close();
  }, [open]);
  const groups = new Map<string, Map<string, string>>();
  for (const { group, keys, label } of shortcuts.value) {
    groups.set(group, (groups.get(group) ?? new Map<string, string>()).set(keys, label));
  }
  const close = () => {
    help_open.value = false;
  };
  return (
    <dialog class="panel help" ref={dialog} aria-labelledby="help-title" onClose={close}>
      {open && (
        <>
          <header class="drawer-head">
            <h2 id="help-title">Keyboard</h2>
            <button type="button" class="bar-button" aria-label="Close" title="Close (Esc)" onClick={close}>
              <Icon name="close" />
            </button>
          </header>
          <div class="help-groups">
            {[...groups].map(([group, entries]) => (
              <section key={group}>
                <h3>{group}</h3>
                <dl>
                  {[...entries].map(([keys, label]) => (
                    <div key={keys}>
                      <dt>
                        {keys.split(/(?<=.)\+(?=.)/).map((key) => (
                          <kbd key={key}>{key.length === 1 ? key.toUpperCase() : key}</kbd>
                        ))}
                      </dt>
                      <dd>{label}</dd>
                    </div>
                  ))}
                </dl>
              </section>
            ))}
          </div>
        </>
      )}
    </dialog>
  );
}
