/** Which panels are open and how large they are: this browser remembers it. */
import { remembered, within, yesOrNo } from "../state/remembered";

const text = (stored: unknown) => (typeof stored === "string" ? stored : null);

/** The panel in the drawer, "" when it is closed. */
export const drawer_panel = remembered("layout.drawer", "", text);
export const drawer_width_px = remembered("layout.drawer_px", 380, within(300, 900));

export const side_open = remembered("layout.side_open", true, yesOrNo);
export const side_panel = remembered("layout.side", "", text);
export const side_width_px = remembered("layout.side_px", 320, within(240, 700));

export const dock_open = remembered("layout.dock_open", true, yesOrNo);
export const dock_panel = remembered("layout.dock", "", text);
/** A share of the screen at first: six rows on a laptop, more where there is room. */
export const dock_height_px = remembered(
  "layout.dock_px",
  Math.round(Math.max(216, 0.3 * innerHeight)),
  within(120, 1400),
);

/** Opens a panel in the drawer, or closes it when it is open. */
export function toggleDrawer(id: string): void {
  drawer_panel.value = drawer_panel.value === id ? "" : id;
}

/** Where the window is narrow there is room for the drawer or the column, not for both (style/layout.css). */
const kNarrow = "(max-width: 1000px)";

/** Shows a panel of the side column. */
export function showSide(id: string): void {
  if (matchMedia(kNarrow).matches) drawer_panel.value = "";
  side_panel.value = id;
  side_open.value = true;
}

/** Shows a panel of the dock. */
export function showDock(id: string): void {
  dock_panel.value = id;
  dock_open.value = true;
}
