import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Station } from "../shell/station";
import { useShortcuts } from "../shell/shortcuts";
import { FleetMap } from "./fleet_map";
import { MapFoot } from "./map_foot";
import { MapTools } from "./map_tools";

interface MapPanelProps {
  station: Station;
  freeArea: () => DOMRect;
}

const kRepeated: ReadonlySet<string> = new Set(["+", "-", "n", "Shift+n"]);
const kPan_px = 80;

const kArrows: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

export function MapPanel({ station, freeArea }: MapPanelProps) {
  const container = useRef<HTMLDivElement>(null);
  const map = useSignal<FleetMap | null>(null);

  useEffect(() => {
    if (container.current === null) return;
    const made = new FleetMap(container.current, station.store, freeArea);
    map.value = made;
    station.map.value = made;
    return () => {
      station.map.value = null;
      map.value = null;
      made.remove();
    };
  }, [station, freeArea, map]);

  const on = (keys: string, label: string, run: (map: FleetMap) => void) => ({
    keys,
    label,
    group: "Map",
    repeats: kRepeated.has(keys),
    run: () => {
      if (map.value !== null) run(map.value);
    },
  });
  useShortcuts([
    on("+", "Zoom in", (m) => {
      m.zoom(0.5);
    }),
    on("-", "Zoom out", (m) => {
      m.zoom(-0.5);
    }),
    on("f", "Fit the map to the fleet", (m) => {
      m.fit();
    }),
    on("l", "Follow the selected, or the fleet", (m) => {
      m.following.value = !m.following.value;
    }),
    on("m", "Measure on the map", (m) => {
      m.measure.toggle();
    }),
    on("b", "Select with a box", (m) => {
      m.box.toggle();
    }),
    on("n", "Select the next UAV", (m) => {
      m.selectNext(1);
    }),
    on("Shift+n", "Select the previous UAV", (m) => {
      m.selectNext(-1);
    }),
    on("Escape", "Leave the map's tool, or select nothing", (m) => {
      m.leave();
    }),
  ]);

  const onKeyDown = (event: KeyboardEvent) => {
    const m = map.value;
    const arrow = kArrows[event.key];
    if (m === null || event.ctrlKey || event.metaKey || event.altKey) return;
    if (arrow !== undefined) m.pan(arrow[0] * kPan_px, arrow[1] * kPan_px);
    else if (event.key === "Enter" && m.measure.active.value) m.measure.addMiddle();
    else if (event.key === "Backspace" && m.measure.active.value) m.measure.takeBack();
    else return;
    event.preventDefault();
  };

  return (
    <>
      <div
        class="map"
        ref={container}
        role="application"
        tabIndex={0}
        aria-label="Map of the fleet. Arrow keys move it."
        onKeyDown={onKeyDown}
      />
      {map.value !== null && <MapTools map={map.value} store={station.store} />}
      {map.value !== null && <MapFoot map={map.value} />}
    </>
  );
}
