/** Waypoints on the map, one marker each, moved and never made anew, so that the focus stays; and a handle midway on each leg. */
import L from "leaflet";

/** Large enough for a finger. */
const kHandle_px = 36;

export interface HandleState {
  at: L.LatLng;
  /** What it is called and shows on hovering. */
  label: string;
  /** In the marker: its number. */
  text: string;
  /** Below the marker; "": nothing. */
  caption: string;
  selected: boolean;
  problem: boolean;
}

export interface HandleActions {
  press(index: number): void;
  drag(index: number, at: L.LatLng): void;
  drop(index: number, at: L.LatLng): void;
  key(index: number, event: KeyboardEvent): void;
}

export class Handles {
  private readonly markers: L.Marker[] = [];
  private dragged = -1;

  constructor(
    private readonly group: L.LayerGroup,
    private readonly kind: "waypoint" | "midpoint",
    private readonly actions: HandleActions,
  ) {}

  show(states: readonly HandleState[]): void {
    while (this.markers.length > states.length) this.markers.pop()?.remove();
    states.forEach((state, i) => {
      const marker = this.markers[i] ?? this.add(state.at, i);
      if (i !== this.dragged) marker.setLatLng(state.at);
      paint(marker.getElement(), state);
    });
  }

  private add(at: L.LatLng, index: number): L.Marker {
    const marker = L.marker(at, {
      icon: L.divIcon({
        className: `plan-handle ${this.kind}`,
        html: "<span></span>",
        iconSize: [kHandle_px, kHandle_px],
      }),
      draggable: true,
      autoPanOnFocus: false,
      bubblingMouseEvents: false,
      zIndexOffset: this.kind === "waypoint" ? 1000 : 0,
    });
    marker.on("click", () => {
      // So that the arrow keys go on where the hand has left off.
      marker.getElement()?.focus({ preventScroll: true });
      this.actions.press(index);
    });
    marker.on("dragstart", () => {
      this.dragged = index;
    });
    marker.on("drag", () => {
      this.actions.drag(index, marker.getLatLng());
    });
    marker.on("dragend", () => {
      this.dragged = -1;
      this.actions.drop(index, marker.getLatLng());
    });
    marker.addTo(this.group);
    marker.getElement()?.addEventListener("keydown", (event) => {
      this.actions.key(index, event);
    });
    this.markers[index] = marker;
    return marker;
  }
}

function paint(element: HTMLElement | undefined, state: HandleState): void {
  if (element === undefined) return;
  element.setAttribute("aria-label", state.label);
  element.title = state.label;
  element.classList.toggle("selected", state.selected);
  element.classList.toggle("problem", state.problem);
  element.dataset["caption"] = state.caption;
  const [text] = element.children;
  if (text !== undefined && text.textContent !== state.text) text.textContent = state.text;
}
