/** The stylesheet's colours, for canvases. One place defines them: style/tokens.css. */

export const kIdentities = 6;

export interface Colours {
  map_land: string;
  map_line: string;
  map_grid: string;
  map_axis: string;
  map_text: string;
  map_halo: string;
  path: string;
  accent: string;
  text: string;
  muted: string;
  tag: string;
  /** By level: 0 clear, 1 advisory, 2 caution, 3 warning. */
  level: readonly [string, string, string, string];
  identity: readonly string[];
}

export function readColours(): Colours {
  const style = getComputedStyle(document.documentElement);
  const value = (name: string) => style.getPropertyValue(name).trim();
  return {
    map_land: value("--map-land"),
    map_line: value("--map-line"),
    map_grid: value("--map-grid"),
    map_axis: value("--map-axis"),
    map_text: value("--map-text"),
    map_halo: value("--map-halo"),
    path: value("--map-path"),
    accent: value("--accent"),
    text: value("--text"),
    muted: value("--muted"),
    tag: value("--map-tag"),
    level: [value("--muted"), value("--advisory"), value("--caution"), value("--warning")],
    identity: Array.from({ length: kIdentities }, (_, i) => value(`--identity-${i + 1}`)),
  };
}

/** 1..kIdentities: which of the identity colours a UAV has. */
export function identityOf(id: number): number {
  return ((id - 1) % kIdentities) + 1;
}
