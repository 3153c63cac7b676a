/** What a person wants drawn on the map: this browser remembers it. */
import { oneOf, remembered, within, yesOrNo } from "../state/remembered";
import { kLongestTrail_min } from "./trails";

export type TrailsOf = "all" | "selected" | "none";

export const trails_of = remembered<TrailsOf>("map.trails", "all", oneOf("all", "selected", "none"));
export const trail_min = remembered("map.trail_min", 5, within(1, kLongestTrail_min));

const shown = (name: string) => remembered(`map.${name}`, true, yesOrNo);

/** In the order of the menu. */
export const layers = {
  labels: { label: "Labels", shown: shown("labels") },
  vectors: { label: "Velocity vectors, 30 s", shown: shown("vectors") },
  slots: { label: "Slots and slot errors", shown: shown("slots") },
  paths: { label: "Paths and waypoints", shown: shown("paths") },
  cylinders: { label: "Cylinder of the selected", shown: shown("cylinders") },
  approaches: { label: "Closest points of threats", shown: shown("approaches") },
  grid: { label: "Grid", shown: shown("grid") },
} as const;

/** What lies under all: "local" is what the bridge serves, "url" a tile server; without one, the offline map alone. */
export type BaseMap = "offline" | "local" | "url";
export const base_map = remembered<BaseMap>("map.base", "local", oneOf("offline", "local", "url"));
