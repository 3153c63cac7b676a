/** The UAVs as they are drawn in this frame: one sight an id, moved from frame to frame and never made again. */
import { kFlown, kHasSlot } from "../link/frames";
import { kLinkLost, type Place } from "../state/fleet";
import type { Store } from "../state/store";
import type { LocalFrame } from "../units/geodesy";
import { identityOf } from "./colours";
import { kFrameRadius_px, kSymbolRadius_px } from "./shapes";
import { mercatorX, mercatorY, xOf, yOf, type Pixel, type View } from "./view";

/** What reaches this far beyond the view may still be seen in it [px]. */
const kMargin_px = 60;

export interface Sight extends Pixel {
  readonly id: number;
  readonly identity: number;
  place: Place;
  /** 0 clear, 1 advisory, 2 caution, 3 warning. */
  level: number;
  /** The UAV that is the reason for the level, 0: none. */
  threat_id: number;
  lost: boolean;
  /** It flies in no formation, while others do: traffic to them. */
  stranger: boolean;
  selected: boolean;
  in_view: boolean;
  uncertainty_m: number;
  speed_m_s: number;
  course_rad: number;
  climb_rad: number;
  formation_id: number;
}

export const clearanceOf = (sight: Sight) => (sight.level > 0 ? kFrameRadius_px : kSymbolRadius_px);

export class Sights {
  private readonly by_id = new Map<number, Sight>();
  /** All, in the order of the telemetry. */
  all: readonly Sight[] = [];
  /** Those that are to be drawn. */
  visible: readonly Sight[] = [];
  /** Of those that are to be drawn. */
  fastest_m_s = 0;

  get(id: number): Sight | undefined {
    return this.by_id.get(id);
  }

  clear(): void {
    this.by_id.clear();
    this.all = [];
    this.visible = [];
  }

  look(store: Store, view: View, frame: LocalFrame, now_ms: number): void {
    const { fleet } = store;
    const { motion, status } = fleet;
    if (motion === null) {
      this.clear();
      return;
    }
    const selection = store.selection.peek();
    const formations = store.statuses.peek().size;
    const all: Sight[] = [];
    for (let row = 0; row < motion.count; row += 1) {
      const sight = this.sightOf(motion.id[row]);
      sight.place = fleet.placeAt(row, now_ms);
      const { east_m, north_m, up_m } = sight.place;
      const at = frame.toLatLon(east_m, north_m, up_m);
      sight.x = xOf(view, mercatorX(at.longitude_deg));
      sight.y = yOf(view, mercatorY(at.latitude_deg));
      sight.speed_m_s = motion.speed_m_s[row];
      sight.course_rad = motion.course_rad[row];
      sight.climb_rad = motion.climb_rad[row];
      sight.selected = selection.has(sight.id);
      sight.in_view =
        sight.x > -kMargin_px &&
        sight.y > -kMargin_px &&
        sight.x < view.width_px + kMargin_px &&
        sight.y < view.height_px + kMargin_px;
      const s = fleet.statusRow(sight.id);
      const judged = status !== null && s >= 0;
      sight.level = judged ? status.level[s] : 0;
      sight.threat_id = judged && sight.level > 0 ? status.level_with_id[s] : 0;
      sight.lost = judged && status.downlink[s] === kLinkLost;
      sight.uncertainty_m = judged ? status.horizontal_uncertainty_m[s] : 0;
      sight.formation_id = judged ? status.formation_id[s] : 0;
      sight.stranger = judged && formations > 0 && (status.flags[s] & (kHasSlot | kFlown)) === 0;
      all.push(sight);
    }
    this.all = all;
    this.visible = all.filter((sight) => sight.in_view);
    this.fastest_m_s = this.visible.reduce((most, { speed_m_s }) => Math.max(most, speed_m_s), 0);
    if (this.by_id.size > all.length) this.forget(all);
  }

  private sightOf(id: number): Sight {
    let sight = this.by_id.get(id);
    if (sight === undefined) {
      sight = {
        id,
        identity: identityOf(id),
        x: 0,
        y: 0,
        place: { east_m: 0, north_m: 0, up_m: 0 },
        level: 0,
        threat_id: 0,
        lost: false,
        stranger: false,
        selected: false,
        in_view: false,
        uncertainty_m: 0,
        speed_m_s: 0,
        course_rad: 0,
        climb_rad: 0,
        formation_id: 0,
      };
      this.by_id.set(id, sight);
    }
    return sight;
  }

  private forget(kept: readonly Sight[]): void {
    const ids = new Set(kept.map((sight) => sight.id));
    for (const id of this.by_id.keys()) if (!ids.has(id)) this.by_id.delete(id);
  }
}
