/** Paths as KML 2.3 (OGC 12-007r2). Properties of waypoints are ExtendedData, with the names that GeoJSON has. */
import { kml } from "@tmcw/togeojson";
import type { Position } from "geojson";
import type { LocalFrame } from "../units/geodesy";
import { fromGeoJson, toGeoJson } from "./geojson";
import { PathFileError, type Defaults, type PathFile } from "./path_file";
import type { PathPlan } from "./path_plan";

/** Throws a PathFileError with what is wrong. The browser's DOMParser, or another where there is none. */
export type XmlParser = (text: string) => Document;

export function parseXml(text: string): Document {
  const parsed = new DOMParser().parseFromString(text, "application/xml");
  const error = parsed.querySelector("parsererror");
  if (error !== null) {
    throw new PathFileError(`The file is no XML: ${(error.textContent ?? "").trim().split("\n")[0] ?? ""}`);
  }
  return parsed;
}

export function toKml(
  plan: PathPlan,
  line: readonly (readonly [number, number, number])[],
  frame: LocalFrame,
  name: string,
): string {
  let count = 0;
  const placemarks = toGeoJson(plan, line, frame).features.map(({ geometry, properties }) => {
    const data = Object.entries(properties ?? {}).map(
      ([key, value]) => `<Data name="${key}"><value>${String(value)}</value></Data>`,
    );
    const positions: Position[] =
      geometry.type === "LineString"
        ? geometry.coordinates
        : geometry.type === "Point"
          ? [geometry.coordinates]
          : [];
    if (geometry.type === "Point") count += 1;
    return [
      `<Placemark><name>${geometry.type === "Point" ? String(count) : "As flown"}</name>`,
      `<ExtendedData>${data.join("")}</ExtendedData>`,
      `<${geometry.type}><altitudeMode>absolute</altitudeMode>`,
      `<coordinates>${positions.map((position) => position.join(",")).join(" ")}</coordinates>`,
      `</${geometry.type}></Placemark>`,
    ].join("");
  });
  return [
    '<?xml version="1.0" encoding="UTF-8"?>',
    '<kml xmlns="http://www.opengis.net/kml/2.2"><Document>',
    `<name>${escaped(name)}</name>`,
    ...placemarks,
    "</Document></kml>",
    "",
  ].join("\n");
}

export function fromKml(text: string, frame: LocalFrame, defaults: Defaults, parse: XmlParser): PathFile {
  const document = parse(text);
  const root = document.documentElement.localName;
  if (root !== "kml") throw new PathFileError(`The file is XML, but <${root}> where KML has <kml>.`);
  const notes = settleAltitudes(document, frame.origin.altitude_m);
  const path = fromGeoJson(kml(document, { skipNullGeometry: true }), frame, defaults);
  return { ...path, notes: [...notes, ...path.notes] };
}

/** Rewrites every geometry's altitudes as GeoJSON has them, by its altitude mode, and checks its coordinates. */
function settleAltitudes(document: Document, origin_altitude_m: number): string[] {
  const notes = new Set<string>();
  for (const coordinates of document.getElementsByTagName("coordinates")) {
    const geometry = geometryOf(coordinates);
    const mode = textOf(geometry, "altitudeMode") ?? textOf(geometry, "gx:altitudeMode") ?? "clampToGround";
    const placemark = nameOf(coordinates);
    const rewritten = tuplesOf(coordinates.textContent ?? "", placemark).map(
      ([longitude, latitude, altitude]) => {
        if (altitude === undefined) return [longitude, latitude];
        if (mode === "absolute") return [longitude, latitude, altitude];
        if (mode === "relativeToGround") {
          notes.add("Altitudes above the ground are taken as above the local origin.");
          return [longitude, latitude, altitude + origin_altitude_m];
        }
        if (mode !== "clampToGround")
          throw new PathFileError(`${placemark}: the altitude mode ${mode} can't be flown.`);
        notes.add("The path lies on the ground (clampToGround), so its altitudes are left out.");
        return [longitude, latitude];
      },
    );
    coordinates.textContent = rewritten.map((tuple) => tuple.join(",")).join(" ");
    if (mode === "absolute") {
      notes.add("Altitudes above sea level are taken on the same reference as the origin's altitude.");
    }
  }
  return [...notes];
}

/** A polygon's ring is two elements down; altitude mode stands in the polygon. */
function geometryOf(coordinates: Element): Element | null {
  const parent = coordinates.parentElement;
  return parent?.localName === "LinearRing" ? (parent.parentElement?.parentElement ?? parent) : parent;
}

function tuplesOf(text: string, placemark: string): [number, number, number?][] {
  return text
    .trim()
    .split(/\s+/)
    .filter((tuple) => tuple !== "")
    .map((tuple, i) => {
      const numbers = tuple.split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
      if (numbers.length < 2 || numbers.length > 3 || !numbers.every(Number.isFinite)) {
        throw new PathFileError(
          `${placemark}: coordinate ${i + 1} is “${tuple.slice(0, 40)}”, not longitude,latitude[,altitude].`,
        );
      }
      return numbers as [number, number, number?];
    });
}

/** Of the placemark around an element, for people. */
function nameOf(element: Element): string {
  let around: Element | null = element;
  while (around !== null && around.localName !== "Placemark") around = around.parentElement;
  const name = textOf(around, "name");
  return name === null || name === "" ? "A placemark without a name" : `Placemark “${name}”`;
}

function textOf(parent: Element | null, tag: string): string | null {
  const child = parent?.getElementsByTagName(tag)[0];
  return child?.textContent?.trim() ?? null;
}

function escaped(text: string): string {
  return text.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
}
