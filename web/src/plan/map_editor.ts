/** The draft on the map: waypoints to take hold of, the arcs as they will be flown, the formation's predicted tracks. */
import { effect } from "@preact/signals";
import L from "leaflet";
import { identityOf, readColours } from "../map/colours";
import type { MapAccess } from "../map/map_access";
import { theme } from "../state/settings";
import { altitudeAbove, speed } from "../units/quantities";
import { inChosenUnits } from "../units/station_text";
import { toLocal } from "./path_file";
import { legEnds, midway, type PathPlan, type Place } from "./path_plan";
import type { Planner } from "./planner";
import type { FlightPreview } from "./preview";
import { closestPair } from "./separation";
import { pressOnWaypoint } from "./waypoint_keys";
import { Handles, type HandleState } from "./waypoint_handles";

/** Legs shorter than this on the screen have no handle: it would lie under those of the waypoints. */
const kLegWithHandle_px = 90;
/** More captions would cover each other. */
const kMostCaptions = 40;
export class MapEditor {
  private readonly group = L.layerGroup();
  private readonly lines = L.layerGroup().addTo(this.group);
  private readonly tracks = L.layerGroup().addTo(this.group);
  private readonly waypoints: Handles;
  private readonly midpoints: Handles;
  private readonly undo: (() => void)[] = [];
  /** The legs that have a handle, in the order of the handles. */
  private handled_legs: number[] = [];

  constructor(
    private readonly map: MapAccess,
    private readonly planner: Planner,
  ) {
    this.group.addTo(map.leaflet);
    this.waypoints = new Handles(this.group, "waypoint", {
      press: (index) => {
        this.select(index);
      },
      drag: (index, at) => {
        this.select(index);
        this.drag(index, at);
      },
      drop: () => this.planner.draft.peek()?.history.endGesture(),
      key: (index, event) => {
        this.key(index, event);
      },
    });
    this.midpoints = new Handles(this.group, "midpoint", {
      press: (index) => {
        this.insertAt(index);
      },
      drag: () => undefined,
      drop: (index, at) => {
        this.insertAt(index, at);
      },
      key: () => undefined,
    });
    this.listen();
  }

  remove(): void {
    for (const step of this.undo) step();
    this.group.remove();
  }

  private get draft() {
    return this.planner.draft.peek();
  }

  private listen(): void {
    const { leaflet } = this.map;
    const redraw = () => {
      this.drawMidpoints(this.draft?.plan.peek() ?? null);
    };
    const press = (event: L.LeafletMouseEvent) => {
      if (this.planner.drawing.peek()) this.add(event.latlng);
    };
    // A long press, or the other mouse button, adds without drawing.
    const long_press = (event: L.LeafletMouseEvent) => {
      event.originalEvent.preventDefault();
      const kept = !this.planner.drawing.peek() && this.map.keepsLongPress(event.containerPoint);
      if (kept || this.planner.review.peek() !== null) return;
      this.add(event.latlng);
    };
    leaflet.on("zoomend", redraw).on("click", press).on("contextmenu", long_press);
    this.undo.push(
      () => leaflet.off("zoomend", redraw).off("click", press).off("contextmenu", long_press),
      effect(() => {
        if (!this.planner.drawing.value) return;
        return this.map.claim({
          cursor: "crosshair",
          onLost: () => {
            this.planner.drawing.value = false;
          },
        });
      }),
      effect(() => {
        this.drawWaypoints();
      }),
      effect(() => {
        this.drawLines();
      }),
      effect(() => {
        this.drawTracks();
      }),
    );
  }

  private select(index: number): void {
    if (this.draft !== null) this.draft.selected.value = index;
  }

  private add(at: L.LatLng): void {
    const place = this.placeOf(at, this.planner.defaults().up_m);
    if (place !== null) this.planner.append(place);
  }

  private insertAt(handle: number, at?: L.LatLng): void {
    const leg = this.handled_legs[handle];
    if (leg === undefined || this.draft === null) return;
    const place = at === undefined ? null : this.placeOf(at, 0);
    this.draft.insertOnLeg(leg, place ?? undefined);
  }

  private drag(index: number, at: L.LatLng): void {
    const point = this.draft?.plan.peek().waypoints[index];
    if (point === undefined) return;
    const place = this.placeOf(at, point.up_m);
    if (place !== null) this.draft?.set(index, place, "place", `drag ${index}`);
  }

  private key(index: number, event: KeyboardEvent): void {
    if (this.draft === null || pressOnWaypoint(this.draft, index, event)) return;
    if (event.key === "Enter" || event.key === " ") this.select(index);
  }

  /** In the local frame at a height, so that it is drawn where it was put. */
  private placeOf(at: L.LatLng, up_m: number): Place | null {
    const frame = this.map.frame();
    if (frame === null) return null;
    const { east_m, north_m } = toLocal(frame, { latitude_deg: at.lat, longitude_deg: at.lng, up_m });
    return { east_m, north_m };
  }

  private drawWaypoints(): void {
    // Before a roster was heard there is no place to draw anything.
    void this.planner.store.roster.value;
    const draft = this.planner.draft.value;
    const plan = draft?.plan.value ?? null;
    const problems = new Map(
      this.planner.problems.value.map(({ waypoint_index, text }) => [waypoint_index, text] as const),
    );
    const states = (plan?.waypoints ?? []).flatMap((point, i): HandleState[] => {
      const at = this.map.place(point.east_m, point.north_m, point.up_m);
      if (at === null) return [];
      const problem = problems.get(i);
      const values = `${altitudeAbove(point.up_m)}, ${speed.full(point.speed_m_s, 1)}`;
      return [
        {
          at,
          text: String(i + 1),
          label: `Waypoint ${i + 1}: ${values}${problem === undefined ? "" : `. ${inChosenUnits(problem)}`}`,
          caption: (plan?.waypoints.length ?? 0) > kMostCaptions ? "" : altitudeAbove(point.up_m),
          selected: draft?.selected.value === i,
          problem: problem !== undefined,
        },
      ];
    });
    this.waypoints.show(states);
    this.drawMidpoints(plan);
  }

  private drawMidpoints(plan: PathPlan | null): void {
    this.handled_legs = [];
    const states: HandleState[] = [];
    for (const [from, to] of plan === null ? [] : legEnds(plan)) {
      const [start, end] = [plan?.waypoints[from], plan?.waypoints[to]];
      if (start === undefined || end === undefined) continue;
      const middle = midway(start, end);
      const [a, b, at] = [start, end, middle].map(({ east_m, north_m, up_m }) =>
        this.map.place(east_m, north_m, up_m),
      );
      if (!a || !b || !at) continue;
      const { leaflet } = this.map;
      const long_px = leaflet.latLngToLayerPoint(a).distanceTo(leaflet.latLngToLayerPoint(b));
      if (long_px < kLegWithHandle_px) continue;
      this.handled_legs.push(from);
      const label = `Insert a waypoint between ${from + 1} and ${to + 1}`;
      states.push({ at, label, text: "+", caption: "", selected: false, problem: false });
    }
    this.midpoints.show(states);
  }

  /** Straight legs until the arcs are known, and where they can't be flown. */
  private drawLines(): void {
    void theme.value;
    const { accent, text } = readColours();
    const plan = this.planner.draft.value?.plan.value ?? null;
    const geometry = this.planner.preview.geometry.value;
    const drawing = this.planner.drawing.value;
    const broken = new Set(
      this.planner.problems.value.flatMap((one) => (one.on_leg ? [one.waypoint_index] : [])),
    );
    this.lines.clearLayers();
    if (plan === null || plan.waypoints.length === 0) return;
    const arcs = geometry?.plan === plan && geometry.preview.ok ? geometry.preview.line : [];
    if (arcs.length > 1) {
      this.addLine(this.lines, arcs, { color: accent, weight: 3, opacity: 0.95 });
    }
    for (const [from, to] of legEnds(plan)) {
      const ends = [plan.waypoints[from], plan.waypoints[to]].flatMap((point): Point[] =>
        point === undefined ? [] : [[point.east_m, point.north_m, point.up_m]],
      );
      this.addLine(this.lines, ends, {
        color: broken.has(from) ? text : accent,
        weight: broken.has(from) ? 3 : 1.5,
        opacity: arcs.length > 1 ? 0.35 : 0.9,
        dashArray: "4 6",
      });
      // To be hit with a finger, too.
      const hit = this.addLine(this.lines, ends, { opacity: 0, weight: 20, interactive: drawing });
      hit.on("click", (event) => {
        const place = this.placeOf(event.latlng, 0);
        if (place !== null) this.draft?.insertOnLeg(from, place);
      });
    }
  }

  private drawTracks(): void {
    void theme.value;
    const colours = readColours();
    const plan = this.planner.draft.value?.plan.value;
    const flight = this.planner.preview.flight.value;
    this.tracks.clearLayers();
    if (flight === null || flight.plan !== plan) return;
    for (const { id, points } of flight.preview.tracks) {
      this.addLine(
        this.tracks,
        points.map(([, east_m, north_m, up_m]): Point => [east_m, north_m, up_m]),
        { color: colours.identity[identityOf(id) - 1] ?? colours.text, weight: 1.5, opacity: 0.8 },
      );
    }
    this.drawClosest(flight.preview, colours.text);
  }

  private drawClosest(flight: FlightPreview, color: string): void {
    const pair = closestPair(flight);
    this.addLine(this.tracks, pair, { color, weight: 1.5 });
    for (const [east_m, north_m, up_m] of pair) {
      const at = this.map.place(east_m, north_m, up_m);
      if (at !== null) {
        this.tracks.addLayer(L.circleMarker(at, { radius: 4, color, weight: 1.5, interactive: false }));
      }
    }
  }

  private addLine(to: L.LayerGroup, points: readonly Point[], options: L.PolylineOptions): L.Polyline {
    const places = points.flatMap((point) => this.map.place(...point) ?? []);
    const line = L.polyline(places, { interactive: false, bubblingMouseEvents: false, ...options });
    return line.addTo(to);
  }
}

type Point = readonly [east_m: number, north_m: number, up_m: number];
