/** Natural Earth's outlines are for a globe. On a flat map an outline that crosses the date line must run on, not jump back. */
import type { Feature, FeatureCollection, MultiLineString, Position } from "geojson";

const kPole_deg = 90;

/** The line with longitudes that run on beyond 180 degrees instead of jumping. */
export function unrolled(line: readonly Position[]): Position[] {
  let shift_deg = 0;
  return line.map((position, i) => {
    const step_deg = i === 0 ? 0 : position[0] - line[i - 1][0];
    if (step_deg > 180) shift_deg -= 360;
    else if (step_deg < -180) shift_deg += 360;
    return [position[0] + shift_deg, position[1]];
  });
}

/** A ring made flat. One that goes around a pole (Antarctica) doesn't close on a flat map: it is closed along the pole. */
export function flatRing(ring: readonly Position[]): Position[] {
  const flat = unrolled(ring);
  const [first, last] = [flat[0], flat[flat.length - 1]];
  if (Math.abs(last[0] - first[0]) < 180) return flat;
  const pole_deg = first[1] < 0 ? -kPole_deg : kPole_deg;
  return [...flat, [last[0], pole_deg], [first[0], pole_deg], first];
}

/** All rings of land, made flat. */
export function flatLand(land: Feature | FeatureCollection): Position[][] {
  const features = land.type === "Feature" ? [land] : land.features;
  return features.flatMap(({ geometry }) => {
    if (geometry.type === "Polygon") return geometry.coordinates.map(flatRing);
    if (geometry.type === "MultiPolygon") return geometry.coordinates.flat().map(flatRing);
    return [];
  });
}

export function flatLines(lines: MultiLineString): Position[][] {
  return lines.coordinates.map(unrolled);
}
