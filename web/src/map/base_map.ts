/** What lies under everything, the operator's tiles too: land and borders that are always there. */
import L from "leaflet";
import type { FeatureCollection } from "geojson";
import { feature, mesh } from "topojson-client";
import type { GeometryCollection, Topology } from "topojson-specification";
import atlas_url from "world-atlas/countries-50m.json?url";
import { flatLand, flatLines } from "./antimeridian";
import type { Colours } from "./colours";

type Atlas = Topology<{ land: GeometryCollection; countries: GeometryCollection }>;

const kPane = "land";

/** Natural Earth's land and borders, served with the page. */
export class Land {
  private readonly renderer = L.canvas({ pane: kPane });
  private readonly land = L.featureGroup();
  private readonly borders = L.featureGroup();
  private colours: Colours | null = null;

  constructor(map: L.Map) {
    // Below the tiles: where there are some, they are the better map.
    map.createPane(kPane).style.zIndex = "150";
    this.land.addTo(map);
    this.borders.addTo(map);
  }

  async load(): Promise<void> {
    const response = await fetch(atlas_url);
    if (!response.ok) throw new Error(`${atlas_url}: ${response.status}`);
    const atlas = (await response.json()) as Atlas;
    const land = flatLand(feature(atlas, atlas.objects.land));
    const borders = flatLines(mesh(atlas, atlas.objects.countries, (a, b) => a !== b));
    // The world three times over, so that a fleet at the date line has land on both sides.
    for (const shift_deg of [0, -360, 360]) {
      const options: L.GeoJSONOptions = {
        interactive: false,
        ...{ pane: kPane, renderer: this.renderer },
        coordsToLatLng: (at) => L.latLng(at[1], at[0] + shift_deg),
        attribution: "Natural Earth",
      };
      this.land.addLayer(
        L.geoJSON({ type: "FeatureCollection", features: land } as FeatureCollection, options),
      );
      this.borders.addLayer(L.geoJSON(borders, options));
    }
    if (this.colours !== null) this.paint(this.colours);
  }

  paint(colours: Colours): void {
    this.colours = colours;
    this.land.setStyle({ color: colours.map_line, weight: 1, fillColor: colours.map_land, fillOpacity: 1 });
    this.borders.setStyle({ color: colours.map_line, weight: 1, fill: false });
  }
}
