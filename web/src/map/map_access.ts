/** What editors get of the map, to draw on it with layers of their own. */
import type L from "leaflet";
import type { LocalFrame } from "../units/geodesy";

export interface EnuPoint {
  east_m: number;
  north_m: number;
}

export interface MapAccess {
  readonly leaflet: L.Map;
  /** The local frame of the fleet; null before a roster was heard. */
  frame(): LocalFrame | null;
  /** Where a point of the local frame lies on the map; null before a roster was heard. */
  place(east_m: number, north_m: number, up_m?: number): L.LatLng | null;
  /** A place on the map, at the height of the origin, in the local frame. */
  enu(at: L.LatLng): EnuPoint | null;
  /** The part of the map that no panel covers. */
  freeArea(): DOMRect;
  /** Shows the whole fleet. */
  fit(): void;
  /** Brings a place into the middle of the free area, and follows nobody any more. */
  centre(place: L.LatLng): void;
  /**
   * Whoever claims the map gets its clicks, and nothing is selected by them, until the returned function is called. One at a
   * time: a later claim ends the earlier one, which is told by `onLost`.
   */
  claim(tool: MapTool): () => void;
  /** A long press there selects a UAV, or is nobody's because a tool has the map. */
  keepsLongPress(at: L.Point): boolean;
}

export interface MapTool {
  cursor: string;
  onLost(): void;
}
