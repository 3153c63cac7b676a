import type { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";

export interface Tab {
  id: string;
  title: string;
  /** A count or lamp beside the title. */
  badge?: ComponentChildren;
}

interface TabsProps {
  label: string;
  tabs: readonly Tab[];
  shown: string;
  show: (id: string) => void;
  /** Id of the element that a tab shows. */
  controls: string;
}

/** Tabs as the keyboard knows them: arrows move, the one that is shown has the focus. */
export function Tabs({ label, tabs, shown, show, controls }: TabsProps) {
  const list = useRef<HTMLDivElement>(null);
  const press = (event: KeyboardEvent) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    const at = tabs.findIndex((tab) => tab.id === shown);
    const next = tabs[(at + step + tabs.length) % tabs.length];
    if (next === undefined) return;
    event.preventDefault();
    show(next.id);
    list.current?.querySelector<HTMLElement>(`[data-tab="${next.id}"]`)?.focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label={label} ref={list} onKeyDown={press}>
      {tabs.map((tab) => (
        <button
          key={tab.id}
          type="button"
          role="tab"
          data-tab={tab.id}
          aria-selected={tab.id === shown}
          aria-controls={controls}
          tabIndex={tab.id === shown ? 0 : -1}
          onClick={() => {
            show(tab.id);
          }}
        >
          {tab.title}
          {tab.badge}
        </button>
      ))}
    </div>
  );
}
