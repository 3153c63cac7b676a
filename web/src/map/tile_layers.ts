/** The operator's own maps as Leaflet layers: tiles by URL, a folder or a PMTiles file that web-bridge serves. */
import L from "leaflet";
import { PMTiles, TileType } from "pmtiles";
import type { Hello } from "../link/messages";
import type { Theme } from "../state/settings";
import type { BaseMap } from "./layers";
import type { ArchiveOptions } from "./vector_layer";

const kClosest_zoom = 19;
/** Tiles are enlarged by this many levels at most: beyond, one covers many screens and the browser groans. */
const kMostEnlarged = 4;
const closest = (max_zoom: number) => Math.min(kClosest_zoom, max_zoom + kMostEnlarged);

export interface BaseChoice {
  base: BaseMap;
  label: string;
}

/** What there is to choose from, the offline map first. */
export function baseChoices(hello: Hello | null): BaseChoice[] {
  const choices: BaseChoice[] = [{ base: "offline", label: "Offline outlines" }];
  const tiles = hello?.tiles ?? null;
  const tile_url = hello?.tile_url ?? null;
  if (tiles !== null) choices.push({ base: "local", label: tiles.name });
  if (tile_url !== null) choices.push({ base: "url", label: hostOf(tile_url) });
  return choices;
}

/** The choice, or the next best of what there is. */
export function baseInForce(hello: Hello | null, wanted: BaseMap): BaseMap {
  const there = baseChoices(hello).map(({ base }) => base);
  return there.includes(wanted) ? wanted : (there.at(-1) ?? "offline");
}

function hostOf(url: string): string {
  return /^https?:\/\/(?:\{s\}\.)?([^/]+)/.exec(url)?.[1] ?? url;
}

/** The layer for a choice; null for the offline map alone. Throws an Error that says for people what is wrong with a file. */
export async function tileLayerFor(
  hello: Hello | null,
  base: BaseMap,
  theme: Theme,
): Promise<L.GridLayer | null> {
  const tile_url = hello?.tile_url ?? null;
  if (base === "url" && tile_url !== null)
    return L.tileLayer(tile_url, { attribution: hello?.tile_attribution ?? "", maxZoom: kClosest_zoom });
  const tiles = hello?.tiles ?? null;
  if (base !== "local" || tiles === null) return null;
  if (tiles.kind === "pmtiles") return archiveLayer(tiles.url, theme);
  return L.tileLayer(tiles.url, {
    attribution: tiles.attribution,
    minZoom: tiles.min_zoom,
    maxNativeZoom: tiles.max_zoom,
    maxZoom: closest(tiles.max_zoom),
  });
}

async function archiveLayer(url: string, theme: Theme): Promise<L.GridLayer> {
  const archive = new PMTiles(new URL(url, document.baseURI).href);
  const header = await archive.getHeader();
  const metadata = (await archive.getMetadata()) as Metadata | null;
  const options: ArchiveOptions = {
    attribution: typeof metadata?.attribution === "string" ? metadata.attribution : "",
    minZoom: header.minZoom,
    maxNativeZoom: header.maxZoom,
    maxZoom: closest(header.maxZoom),
    bounds: L.latLngBounds([header.minLat, header.minLon], [header.maxLat, header.maxLon]),
  };
  if (header.tileType !== TileType.Mvt) return new ArchiveLayer(archive, options);
  const listed = metadata?.vector_layers;
  const layers = Array.isArray(listed) ? listed.map(({ id }) => id) : [];
  if (layers.length === 0) throw new Error("it doesn't say which layers its vector tiles have");
  const { vectorLayer } = await import("./vector_layer");
  return vectorLayer(archive, layers, theme, options);
}

/** What the specification of PMTiles says of its metadata, as far as it is used. */
interface Metadata {
  attribution?: unknown;
  vector_layers?: { id: string }[];
}

/** Tiles drawn from the bytes in a PMTiles file: no request and no address for each. */
class ArchiveLayer extends L.GridLayer {
  constructor(
    private readonly archive: PMTiles,
    options: L.GridLayerOptions,
  ) {
    super(options);
  }

  override createTile(coords: L.Coords, done: L.DoneCallback): HTMLElement {
    const tile = document.createElement("canvas");
    this.draw(tile, coords).then(
      () => {
        done(undefined, tile);
      },
      (error: unknown) => {
        done(error instanceof Error ? error : new Error(String(error)), tile);
      },
    );
    return tile;
  }

  private async draw(tile: HTMLCanvasElement, { x, y, z }: L.Coords): Promise<void> {
    const found = await this.archive.getZxy(z, x, y);
    if (found === undefined) return;
    const image = await createImageBitmap(new Blob([found.data]));
    tile.width = image.width;
    tile.height = image.height;
    tile.getContext("2d")?.drawImage(image, 0, 0);
    image.close();
  }
}
