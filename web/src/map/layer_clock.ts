/** When a layer of the map is drawn: as seldom as nobody sees, and never so often that nothing else has time. */

const kGroundInterval_ms = 500;
/** A map that moves takes what was drawn along, so that it need not be drawn in every frame. */
const kMovedInterval_ms = 80;
const kLongestMovedInterval_ms = 400;
/** A fleet that moves visibly is drawn so often. */
const kFleetInterval_ms = 30;
/** Who moves by less than this isn't seen to move [px]. */
const kLeastShift_px = 0.5;
/** A fleet that is not seen to move is drawn so often nevertheless: levels and labels change. */
const kStillInterval_ms = 100;
/** Where drawing is slow (no GPU, a busy machine), it leaves this part of the time to everything else, within reason. */
const kIdlePart = 0.5;
const kLongestFleetInterval_ms = 200;

/** When a layer was drawn last, and what that cost. */
export class LayerClock {
  /** What it shows has changed, not just moved on. */
  old = true;
  /** From one frame of the screen to the next, when this layer was drawn in it [ms]. */
  cost_ms = 0;
  private demanded = false;
  private drawn_ms = -Infinity;
  private just_drawn = false;

  /** At the beginning of each frame of the screen: what drawing costs shows in when the next frame comes. */
  tick(now_ms: number): void {
    if (this.just_drawn) this.cost_ms = now_ms - this.drawn_ms;
    this.just_drawn = false;
  }

  /** Another view altogether: what was drawn would be seen to be wrong until the layer is due. */
  demand(): void {
    this.old = this.demanded = true;
  }

  isDue(now_ms: number, interval_ms: number): boolean {
    return this.demanded || now_ms - this.drawn_ms >= interval_ms;
  }

  drawn(now_ms: number): void {
    this.old = this.demanded = false;
    this.drawn_ms = now_ms;
    this.just_drawn = true;
  }
}

export function groundInterval_ms({ old, cost_ms }: LayerClock): number {
  if (!old) return kGroundInterval_ms;
  return Math.min(Math.max(kMovedInterval_ms, 4 * cost_ms), kLongestMovedInterval_ms);
}

/** @param speed_px_s of the fastest on the screen */
export function fleetInterval_ms({ old, cost_ms }: LayerClock, speed_px_s: number): number {
  const seen_ms = old ? 0 : Math.min((1000 * kLeastShift_px) / speed_px_s, kStillInterval_ms);
  const fair_ms = cost_ms / (1 - kIdlePart);
  return Math.min(Math.max(kFleetInterval_ms, seen_ms, fair_ms), kLongestFleetInterval_ms);
}
