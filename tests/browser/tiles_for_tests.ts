/** Maps of one colour, written by the test that shows them. */
import { mkdirSync, writeFileSync } from "node:fs";
import { crc32, deflateSync } from "node:zlib";
import { fromGeojsonVt } from "vt-pbf";

type Rgb = readonly [number, number, number];

const kSide_px = 256;
const kClosest_zoom = 14;

/** A tile of one colour (PNG specification: signature, IHDR, IDAT, IEND). */
export function png([red, green, blue]: Rgb): Buffer {
  const chunk = (name: string, data: Buffer) => {
    const named = Buffer.concat([Buffer.from(name, "latin1"), data]);
    const framed = Buffer.alloc(named.length + 8);
    framed.writeUInt32BE(data.length, 0);
    named.copy(framed, 4);
    framed.writeUInt32BE(crc32(named), named.length + 4);
    return framed;
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(kSide_px, 0);
  header.writeUInt32BE(kSide_px, 4);
  header.set([8, 2], 8); // 8 bits a channel, RGB
  const line = Buffer.alloc(1 + 3 * kSide_px);
  for (let x = 0; x < kSide_px; x += 1) line.set([red, green, blue], 1 + 3 * x);
  const pixels = deflateSync(Buffer.concat(Array.from({ length: kSide_px }, () => line)));
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([
    signature,
    chunk("IHDR", header),
    chunk("IDAT", pixels),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** A folder with the tiles around a place, from zoom 8 to 14. */
export function writeTileFolder(
  folder: string,
  latitude_deg: number,
  longitude_deg: number,
  colour: Rgb,
): void {
  const tile = png(colour);
  const latitude_rad = (latitude_deg * Math.PI) / 180;
  for (let zoom = 8; zoom <= 14; zoom += 1) {
    const x = Math.floor((longitude_deg / 360 + 0.5) * 2 ** zoom);
    const y = Math.floor((0.5 - Math.asinh(Math.tan(latitude_rad)) / (2 * Math.PI)) * 2 ** zoom);
    for (let column = x - 2; column <= x + 2; column += 1) {
      mkdirSync(`${folder}/${zoom}/${column}`, { recursive: true });
      for (let row = y - 2; row <= y + 2; row += 1)
        writeFileSync(`${folder}/${zoom}/${column}/${row}.png`, tile);
    }
  }
}

const kExtent = 4096;
const kPolygon = 3;
const kLine = 2;

/** A vector tile of water in two upright stripes on land, with a road across all, named as a schema names its layers. */
export function vectorTile(land: string, water: string, roads: string): Buffer {
  const stripe = (left: number, right = left + kExtent / 4) => {
    return [
      [left, 0],
      [right, 0],
      [right, kExtent],
      [left, kExtent],
      [left, 0],
    ] as [number, number][];
  };
  const feature = (type: 2 | 3, geometry: [number, number][][], kind: string) => ({
    features: [{ type, geometry, tags: { kind } }],
  });
  const road: [number, number][] = [
    [0, kExtent / 8],
    [kExtent, kExtent / 8],
  ];
  const layers = {
    [land]: feature(kPolygon, [stripe(0, kExtent)], "earth"),
    [water]: feature(kPolygon, [stripe(0), stripe(kExtent / 2)], "ocean"),
    [roads]: feature(kLine, [road], "highway"),
  };
  return Buffer.from(fromGeojsonVt(layers as never, { version: 2, extent: kExtent }));
}

/** A PMTiles file of tiles of one colour. */
export function writePmtiles(file: string, colour: Rgb): void {
  writeArchive(file, 2, png(colour), { attribution: "Test survey" });
}

/** A PMTiles file of vector tiles. */
export function writeVectorPmtiles(file: string, land: string, water: string, roads: string): void {
  const vector_layers = [land, water, roads].map((id) => ({ id, fields: {} }));
  writeArchive(file, 1, vectorTile(land, water, roads), { attribution: "Vector survey", vector_layers });
}

/** The whole world from zoom 0 to 14: the specification's version 3, nothing compressed, one tile for all places. */
function writeArchive(file: string, tile_type: number, tile: Buffer, about: object): void {
  const varint = (value: number): number[] =>
    value < 128 ? [value] : [(value % 128) + 128, ...varint(Math.floor(value / 128))];
  // One entry: from tile 0 on, as many times as there are tiles, its length, offset 0 (written as 1).
  const tiles = (4 ** (kClosest_zoom + 1) - 1) / 3;
  const directory = Buffer.from([1, 0, ...varint(tiles), ...varint(tile.length), 1]);
  const metadata = Buffer.from(JSON.stringify(about));
  const header = Buffer.alloc(127);
  header.write("PMTiles", 0, "latin1");
  header[7] = 3;
  const data_at = header.length + directory.length + metadata.length;
  const parts = [
    [header.length, directory.length],
    [header.length + directory.length, metadata.length],
    [data_at, 0],
    [data_at, tile.length],
  ].flat();
  [...parts, tiles, 1, 1].forEach((value, i) => header.writeBigUInt64LE(BigInt(value), 8 + 8 * i));
  header.set([1, 1, 1, tile_type, 0, kClosest_zoom], 96); // clustered, not compressed, zooms
  [-180, -85, 180, 85].forEach((degrees, i) => header.writeInt32LE(degrees * 1e7, 102 + 4 * i));
  writeFileSync(file, Buffer.concat([header, directory, metadata, tile]));
}
