/** Vector tiles of a PMTiles file, drawn in greys: on this map colours tell of UAVs. A chunk of its own, loaded when there is such a file. */
import { namedFlavor } from "@protomaps/basemaps";
import type L from "leaflet";
import { PMTiles, type RangeResponse } from "pmtiles";
import {
  CenteredTextSymbolizer,
  GeomType,
  labelRules,
  leafletLayer,
  LineSymbolizer,
  paintRules,
  PolygonSymbolizer,
  type Feature,
  type LabelRule,
  type PaintRule,
} from "protomaps-leaflet";
import type { Theme } from "../state/settings";

const kFlavours = { dark: namedFlavor("black"), light: namedFlavor("grayscale") } as const;

/** What a PMTiles file says of its map. */
export interface ArchiveOptions {
  attribution: string;
  minZoom: number;
  /** Closest zoom of its tiles, and of the map. */
  maxNativeZoom: number;
  maxZoom: number;
  bounds: L.LatLngBounds;
}

/** Tiles that can't be had are empty: the library would write each of them into the browser's console. */
class Archive extends PMTiles {
  override async getZxy(
    z: number,
    x: number,
    y: number,
    signal?: AbortSignal,
  ): Promise<RangeResponse | undefined> {
    try {
      return await super.getZxy(z, x, y, signal);
    } catch (error) {
      if (signal?.aborted) throw error;
      return undefined;
    }
  }
}

interface Rules {
  paintRules: PaintRule[];
  labelRules: LabelRule[];
}

/** @param layers names of the archive's layers. */
export function vectorLayer(
  archive: PMTiles,
  layers: readonly string[],
  theme: Theme,
  { maxNativeZoom, ...options }: ArchiveOptions,
): L.GridLayer {
  const flavour = kFlavours[theme];
  // Protomaps' own schema has "earth" and "roads"; of any other only the names of its layers are known.
  const is_protomaps = layers.includes("earth") && layers.includes("roads");
  const rules: Rules = is_protomaps
    ? { paintRules: paintRules(flavour), labelRules: labelRules(flavour, "en") }
    : plainRules(layers, theme);
  return leafletLayer({
    ...options,
    ...rules,
    url: new Archive(archive.source),
    maxDataZoom: maxNativeZoom,
    backgroundColor: is_protomaps ? flavour.background : flavour.earth,
  }) as unknown as L.GridLayer;
}

/** Layers of OpenMapTiles, Shortbread and the like that cover ground, in the order in which they lie; the rest is lines. */
const kGround: readonly (readonly [RegExp, "park_a" | "water" | "buildings"])[] = [
  [/land|park|wood|forest|grass|site/i, "park_a"],
  [/water|ocean|sea|lake|river/i, "water"],
  [/building/i, "buildings"],
];

/** Ground by what the layers' names say, all lines alike, and whatever has a name and is a place. */
export function plainRules(layers: readonly string[], theme: Theme): Rules {
  const flavour = kFlavours[theme];
  const ofType = (type: GeomType) => (_: number, feature?: Feature) => feature?.geomType === type;
  const ground = kGround.flatMap(([name, colour]) =>
    layers
      .filter((layer) => name.test(layer))
      .map((layer) => ({
        dataLayer: layer,
        symbolizer: new PolygonSymbolizer({ fill: flavour[colour] }),
        filter: ofType(GeomType.Polygon),
      })),
  );
  const lines = layers.map((layer) => ({
    dataLayer: layer,
    symbolizer: new LineSymbolizer({
      color: /water|river/i.test(layer) ? flavour.water : flavour.highway,
      width: 1,
    }),
    filter: ofType(GeomType.Line),
  }));
  const places = layers
    .filter((layer) => /place/i.test(layer))
    .map((layer) => ({
      dataLayer: layer,
      symbolizer: new CenteredTextSymbolizer({
        labelProps: ["name:en", "name_en", "name"],
        fill: flavour.city_label,
        stroke: flavour.city_label_halo,
        width: 2,
        font: "500 12px sans-serif",
      }),
      filter: ofType(GeomType.Point),
    }));
  return { paintRules: [...ground, ...lines], labelRules: places };
}
