import L from "leaflet";
import type { MapAccess } from "../map/map_access";
import type { PathPlan } from "./path_plan";

const kMargin_px = 50;
/** For arcs beyond the outermost waypoints, of the path's own size. */
const kArcs = 0.15;
const kClosest_zoom = 15;

/** Shows the whole path in the part of the map that no panel covers. */
export function showPath(map: MapAccess | null, plan: PathPlan): void {
  if (map === null) return;
  const bounds = L.latLngBounds(
    plan.waypoints.flatMap((point) => map.place(point.east_m, point.north_m, point.up_m) ?? []),
  );
  if (!bounds.isValid()) return;
  const whole = map.leaflet.getContainer().getBoundingClientRect();
  const free = map.freeArea();
  map.leaflet.fitBounds(bounds.pad(kArcs), {
    paddingTopLeft: [free.left - whole.left + kMargin_px, free.top - whole.top + kMargin_px],
    paddingBottomRight: [whole.right - free.right + kMargin_px, whole.bottom - free.bottom + kMargin_px],
    maxZoom: kClosest_zoom,
    animate: false,
  });
}
