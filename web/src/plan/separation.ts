/** Where the formation is closest in a flight ahead. */
import type { FlightPreview } from "./preview";

type Track = FlightPreview["tracks"][number]["points"];

/** Between two points of a track, by its times; at its ends before and after. Null for a track without points. */
export function placeAt(points: Track, t_s: number): [east_m: number, north_m: number, up_m: number] | null {
  const after = points.findIndex(([time_s]) => time_s >= t_s);
  const to = points[after === -1 ? points.length - 1 : after];
  const from = points[Math.max(after - 1, 0)] ?? to;
  if (to === undefined || from === undefined) return null;
  const span_s = to[0] - from[0];
  const part = after > 0 && span_s > 0 ? (t_s - from[0]) / span_s : 1;
  const between = (i: 1 | 2 | 3) => from[i] + part * (to[i] - from[i]);
  return [between(1), between(2), between(3)];
}

/** Both of the pair that comes closest, at that moment. */
export function closestPair({ least, tracks }: FlightPreview): [number, number, number][] {
  if (least === null) return [];
  return least.ids.flatMap((id) => {
    const track = tracks.find((one) => one.id === id);
    const place = track === undefined ? null : placeAt(track.points, least.t_s);
    return place === null ? [] : [place];
  });
}
