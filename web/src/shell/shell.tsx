import { useCallback, useEffect, useRef } from "preact/hooks";
import { ControlNotices } from "../control/control_notices";
import { MapPanel } from "../map/map_panel";
import { FirstRun } from "../panels/first_run";
import { LinkBanner } from "../panels/link_banner";
import { ModeCards } from "../panels/mode_cards";
import { ReplayBanner } from "../panels/replay_banner";
import { Opening } from "../recordings/opening";
import { openingProblem } from "../recordings/opening_problem";
import { Dock, Drawer, Rail, SideColumn } from "./docks";
import { Help } from "./help";
import type { PanelProps } from "./panel_props";
import { SignIn } from "../sign_in/sign_in";
import { TimeLine } from "../timeline/timeline";
import { listenForShortcuts } from "./shortcuts";
import { TopBar } from "./top_bar";

/** One screen: the map under everything, panels around it. The part that no panel covers is the map's free area. */
export function Shell({ station }: PanelProps) {
  const { store } = station;
  const in_sight = useRef<HTMLDivElement>(null);
  const freeArea = useCallback(() => in_sight.current?.getBoundingClientRect() ?? new DOMRect(), []);
  useEffect(listenForShortcuts, []);
  const stale = store.isStale(store.now_ms.value) && store.fleet.motion !== null;
  return (
    <main class={stale ? "app stale" : "app"}>
      <TopBar station={station} />
      <ReplayBanner live={store.hello.value?.recordings?.live_bus === true} />
      <Rail />
      <Drawer station={station} />
      <div class="middle">
        <div class="over-map">
          <MapPanel station={station} freeArea={freeArea} />
          <ModeCards store={store} />
          <div class="in-sight" ref={in_sight} />
          <div class="free">
            {station.session.state.value.kind === "asked" ? (
              <SignIn session={station.session} />
            ) : (
              <>
                {openingProblem(station) === "" && <LinkBanner store={store} retry={station.retry} />}
                <ControlNotices station={station} />
                <FirstRun store={store} />
                <Opening station={station} />
              </>
            )}
          </div>
        </div>
      </div>
      <SideColumn station={station} />
      <Dock station={station} />
      <TimeLine station={station} />
      <Help />
    </main>
  );
}
