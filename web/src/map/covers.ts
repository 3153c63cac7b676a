/** What lies over the map, in pixels of it. */
import type { Box } from "./labels";

const kCovers = ".mode-card, .map-tools > *, .scale, .coordinates, .map-foot .leaflet-control-attribution";

export function coversOf(map: HTMLElement): Box[] {
  const whole = map.getBoundingClientRect();
  return [...(map.parentElement?.querySelectorAll(kCovers) ?? [])].map((element) => {
    const { left, top, right, bottom } = element.getBoundingClientRect();
    return {
      left: left - whole.left,
      top: top - whole.top,
      right: right - whole.left,
      bottom: bottom - whole.top,
    };
  });
}
