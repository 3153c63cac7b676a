/** What lies under everything, the operator's tiles too: Natural Earth's land and borders, served with the page. */
import type { Map as LeafletMap } from "leaflet";
import { feature, mesh } from "topojson-client";
import type { GeometryCollection, Topology } from "topojson-specification";
import atlas_url from "world-atlas/countries-50m.json?url";
import { flatLand, flatLines } from "./antimeridian";
import type { Colours } from "./colours";
import { outlineOf, trace, type Outline } from "./outlines";
import { Overlay } from "./overlay";
import type { View } from "./view";

type Atlas = Topology<{ land: GeometryCollection; countries: GeometryCollection }>;

export class Land {
  private readonly overlay: Overlay;
  private land: Outline[] = [];
  private borders: Outline[] = [];

  constructor(map: LeafletMap) {
    this.overlay = new Overlay(map, "land");
    map.attributionControl.addAttribution("Natural Earth");
  }

  /** To be drawn again after that. */
  async load(): Promise<void> {
    const response = await fetch(atlas_url);
    if (!response.ok) throw new Error(`${atlas_url}: ${response.status}`);
    const atlas = (await response.json()) as Atlas;
    this.land = flatLand(feature(atlas, atlas.objects.land)).map(outlineOf);
    this.borders = flatLines(mesh(atlas, atlas.objects.countries, (a, b) => a !== b)).map(outlineOf);
  }

  remove(): void {
    this.overlay.remove();
  }

  align(view: View): void {
    this.overlay.align(view);
  }

  draw(view: View, colours: Colours): void {
    const context = this.overlay.begin(view);
    context.fillStyle = colours.map_land;
    context.strokeStyle = colours.map_line;
    context.lineWidth = 1;
    context.beginPath();
    for (const ring of this.land) trace(context, ring, view);
    // A lake is a ring within another one.
    context.fill("evenodd");
    for (const line of this.borders) trace(context, line, view);
    context.stroke();
  }
}
