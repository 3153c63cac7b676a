import { useCallback, useRef } from "preact/hooks";
import type { Commands } from "./link/commands";
import { MapPanel } from "./map/map_panel";
import { EventList } from "./panels/event_list";
import { FirstRun } from "./panels/first_run";
import { FormationTable } from "./panels/formation_table";
import { LinkBanner } from "./panels/link_banner";
import { ModeCards } from "./panels/mode_cards";
import { TopBar } from "./panels/top_bar";
import type { Store } from "./state/store";

export interface AppProps {
  store: Store;
  commands: Commands;
  /** Tries to connect at once. */
  retry: () => void;
}

/** One screen: the map under everything, panels over it. The part that no panel covers is the map's free area. */
export function App({ store, commands, retry }: AppProps) {
  const free = useRef<HTMLDivElement>(null);
  const freeArea = useCallback(() => free.current?.getBoundingClientRect() ?? new DOMRect(), []);
  const stale = store.isStale(store.now_ms.value) && store.fleet.motion !== null;
  return (
    <main class={stale ? "app stale" : "app"}>
      <MapPanel store={store} freeArea={freeArea} />
      <TopBar store={store} />
      <ModeCards store={store} />
      <div class="free" ref={free}>
        <LinkBanner store={store} retry={retry} />
        <FirstRun store={store} />
      </div>
      <EventList store={store} />
      <FormationTable store={store} commands={commands} />
    </main>
  );
}
