/** A moment on both clocks, in ms. */
export interface Moment {
  readonly here_ms: number;
  readonly bus_ms: number;
}

/**
 * Time on the bus beside time here (performance.now). Live both go alike; a recording is played faster, slower, backwards or
 * not at all. That it jumps to another moment is no time gone by.
 */
export class Pace {
  private rate = 1;
  private changed: Moment = { here_ms: 0, bus_ms: 0 };

  /** From now on the bus goes `rate` times as fast; 0: it stands, negative: backwards. */
  set(rate: number, now_ms: number): void {
    this.changed = this.moment(now_ms);
    this.rate = rate;
  }

  get speed(): number {
    return Math.abs(this.rate);
  }

  moment(now_ms: number): Moment {
    const bus_ms = this.changed.bus_ms + this.rate * (now_ms - this.changed.here_ms);
    return { here_ms: now_ms, bus_ms };
  }

  /** For how long the bus has gone on since then [ms]; negative when it went backwards. */
  since_ms(then: Moment, now_ms: number): number {
    // The screen's clock may be a little behind.
    return this.moment(Math.max(now_ms, then.here_ms)).bus_ms - then.bus_ms;
  }
}
