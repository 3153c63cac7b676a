/** Files that paths come from and go into, told apart by what they hold. */
import type { LocalFrame } from "../units/geodesy";
import { fromGeoJson, kGeoJsonTypes, toGeoJson } from "./geojson";
import { fromKml, parseXml, toKml, type XmlParser } from "./kml";
import { isObject, PathFileError, type Defaults, type PathFile } from "./path_file";
import { kMostWaypoints, type PathPlan } from "./path_plan";
import { fromQgcPlan, toQgcPlan } from "./qgc_plan";

export type FileKind = "geojson" | "kml" | "plan";

export const kFileKinds: readonly { kind: FileKind; name: string; mime: string; altitudes: string }[] = [
  {
    kind: "geojson",
    name: "GeoJSON",
    mime: "application/geo+json",
    altitudes: "Altitudes count from the origin's own.",
  },
  {
    kind: "kml",
    name: "KML",
    mime: "application/vnd.google-earth.kml+xml",
    altitudes: "Altitudes are absolute, on the reference of the origin's altitude.",
  },
  {
    kind: "plan",
    name: "QGroundControl",
    mime: "application/json",
    altitudes: "Altitudes are above home, which is the local origin.",
  },
];

export const kLargestFile_bytes = 5_000_000;

/** Throws PathFileError. */
export function readPathFile(
  text: string,
  frame: LocalFrame,
  defaults: Defaults,
  parse: XmlParser = parseXml,
): PathFile {
  const path = read(text.replace(/^\uFEFF/, "").trimStart(), frame, defaults, parse);
  if (path.waypoints.length > kMostWaypoints) {
    throw new PathFileError(
      `The file holds ${path.waypoints.length} waypoints; a path has at most ${kMostWaypoints}. Is it a recorded track?`,
    );
  }
  return path;
}

export function writePathFile(
  kind: FileKind,
  plan: PathPlan,
  line: readonly (readonly [number, number, number])[],
  frame: LocalFrame,
  name: string,
): string {
  switch (kind) {
    case "geojson":
      return `${JSON.stringify(toGeoJson(plan, line, frame), null, 1)}\n`;
    case "kml":
      return toKml(plan, line, frame, name);
    case "plan":
      return `${JSON.stringify(toQgcPlan(plan, frame), null, 4)}\n`;
  }
}

function read(text: string, frame: LocalFrame, defaults: Defaults, parse: XmlParser): PathFile {
  if (text.startsWith("PK")) {
    throw new PathFileError("The file is zipped (KMZ?). Unpack it and take the .kml in it.");
  }
  if (text.startsWith("<")) return fromKml(text, frame, defaults, parse);
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch (error) {
    throw new PathFileError(
      text.startsWith("{")
        ? `The file is broken JSON: ${error instanceof Error ? error.message : ""}`
        : "The file is neither GeoJSON nor KML nor a QGroundControl plan.",
    );
  }
  if (isObject(json) && json["fileType"] === "Plan") return fromQgcPlan(json, frame, defaults);
  if (isObject(json) && kGeoJsonTypes.includes(json["type"])) return fromGeoJson(json, frame, defaults);
  throw new PathFileError(
    "The file is JSON, but neither GeoJSON (its type is unknown) nor a QGroundControl plan.",
  );
}
