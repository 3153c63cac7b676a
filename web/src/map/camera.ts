/** Keeps the fleet in the part of the map that no panel covers. */
import L from "leaflet";
import type { Store } from "../state/store";
import type { LocalFrame } from "../units/geodesy";

const kClosestFit_zoom = 15;
const kMargin_px = 40;

/** Follows by steps of at least this [px]: smaller ones can't be seen. */
const kLeastStep_px = 1;

export class Camera {
  constructor(
    private readonly map: L.Map,
    private readonly store: Store,
    private readonly freeArea: () => DOMRect,
  ) {}

  /** Shows the whole fleet with its slots and leaders. False when there is nothing to show. */
  fit(frame: LocalFrame, now_ms: number): boolean {
    const bounds = this.fleetBounds(frame, now_ms);
    for (const status of this.store.statuses.peek().values()) {
      bounds.extend(toLatLng(frame, status.leader_east_m, status.leader_north_m));
      for (const slot of status.slots) bounds.extend(toLatLng(frame, slot.slot_east_m, slot.slot_north_m));
    }
    if (!bounds.isValid()) return false;
    const whole = this.map.getContainer().getBoundingClientRect();
    const free = this.freeArea();
    this.map.fitBounds(bounds, {
      paddingTopLeft: [free.left - whole.left + kMargin_px, free.top - whole.top + kMargin_px],
      paddingBottomRight: [whole.right - free.right + kMargin_px, whole.bottom - free.bottom + kMargin_px],
      maxZoom: kClosestFit_zoom,
      animate: false,
    });
    return true;
  }

  /** Moves the map so that the middle of the selected UAVs, or of the whole fleet, stays in the middle. */
  follow(frame: LocalFrame, now_ms: number): void {
    const selection = this.store.selection.peek();
    const bounds = this.fleetBounds(frame, now_ms, selection.size > 0 ? selection : undefined);
    if (bounds.isValid()) this.centre(bounds.getCenter());
  }

  /** Brings a UAV into sight, if it is not. */
  show(frame: LocalFrame, id: number, now_ms: number): void {
    const bounds = this.fleetBounds(frame, now_ms, new Set([id]));
    if (!bounds.isValid()) return;
    const at = this.map.latLngToContainerPoint(bounds.getCenter());
    const whole = this.map.getContainer().getBoundingClientRect();
    const { left, right, top, bottom } = this.freeArea();
    const [x, y] = [at.x + whole.left, at.y + whole.top];
    if (x < left || x > right || y < top || y > bottom) this.centre(bounds.getCenter());
  }

  /** Where the middle of the part is that no panel covers. */
  middle(): L.LatLng {
    return this.map.containerPointToLatLng(this.freeMiddle());
  }

  /** Brings a place into the middle of the part that no panel covers. */
  centre(place: L.LatLng): void {
    const step = this.map.latLngToContainerPoint(place).subtract(this.freeMiddle());
    if (Math.hypot(step.x, step.y) >= kLeastStep_px) this.map.panBy(step.round(), { animate: false });
  }

  private freeMiddle(): L.Point {
    const whole = this.map.getContainer().getBoundingClientRect();
    const free = this.freeArea();
    return L.point((free.left + free.right) / 2 - whole.left, (free.top + free.bottom) / 2 - whole.top);
  }

  private fleetBounds(frame: LocalFrame, now_ms: number, of?: ReadonlySet<number>): L.LatLngBounds {
    const bounds = L.latLngBounds([]);
    const { fleet } = this.store;
    for (let row = 0; row < (fleet.motion?.count ?? 0); row += 1) {
      if (of !== undefined && !of.has(fleet.motion?.id[row] ?? 0)) continue;
      const place = fleet.placeAt(row, now_ms);
      bounds.extend(toLatLng(frame, place.east_m, place.north_m));
    }
    return bounds;
  }
}

function toLatLng(frame: LocalFrame, east_m: number, north_m: number): L.LatLng {
  const at = frame.toLatLon(east_m, north_m, 0);
  return L.latLng(at.latitude_deg, at.longitude_deg);
}
