/** The flight of some UAVs as charts draw it: one time axis, nine columns a UAV, in typed arrays that don't grow for ever. */

/** In the order of GET /api/history. */
export const kColumns = [
  "up_m",
  "speed_m_s",
  "course_rad",
  "forward_error_m",
  "left_error_m",
  "up_error_m",
  "nearest_horizontal_m",
  "nearest_vertical_m",
  "tau_s",
] as const;
export type ColumnName = (typeof kColumns)[number];
export type Columns = Record<ColumnName, Float32Array>;

/** Nearly three hours at two a second; then every second sample goes. */
const kMostSamples = 20_000;

/** What is not known is NaN: a gap in the curve. */
export class FlightSeries {
  count = 0;
  private t_s: Float64Array;
  private readonly columns = new Map<number, Columns>();

  constructor(
    readonly ids: readonly number[],
    private readonly most = kMostSamples,
  ) {
    this.t_s = new Float64Array(most);
    for (const id of ids) this.columns.set(id, newColumns(most));
  }

  /** Times of the samples, rising [s]. A view: valid until the next `append`. */
  times(): Float64Array {
    return this.t_s.subarray(0, this.count);
  }

  /** A view, valid until the next `append`; null: not one of `ids`. */
  values(id: number, column: ColumnName): Float32Array | null {
    return this.columns.get(id)?.[column].subarray(0, this.count) ?? null;
  }

  last_s(): number {
    return this.count === 0 ? -Infinity : (this.t_s[this.count - 1] ?? -Infinity);
  }

  /** Adds a sample after the last one; `read` gives the values of a UAV. What is no later is not added. */
  append(t_s: number, read: (id: number, column: ColumnName) => number): void {
    if (!(t_s > this.last_s())) return;
    if (this.count === this.most) this.thinOut();
    this.t_s[this.count] = t_s;
    for (const [id, columns] of this.columns) {
      for (const name of kColumns) columns[name][this.count] = read(id, name);
    }
    this.count += 1;
  }

  /** Index of the sample nearest to `t_s`, -1 without any. */
  indexAt(t_s: number): number {
    const after = this.firstAfter(t_s);
    if (after === 0) return this.count === 0 ? -1 : 0;
    if (after === this.count) return this.count - 1;
    const gap_before = t_s - (this.t_s[after - 1] ?? 0);
    return gap_before <= (this.t_s[after] ?? 0) - t_s ? after - 1 : after;
  }

  /** Index of the first sample after `t_s`; `count` when there is none. */
  firstAfter(t_s: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.t_s[middle] ?? 0) <= t_s) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  private thinOut(): void {
    const kept = Math.ceil(this.count / 2);
    const halve = (numbers: Float32Array | Float64Array) => {
      for (let i = 0; i < kept; i += 1) numbers[i] = numbers[2 * i] ?? 0;
    };
    halve(this.t_s);
    for (const columns of this.columns.values()) for (const name of kColumns) halve(columns[name]);
    this.count = kept;
  }
}

function newColumns(length: number): Columns {
  return Object.fromEntries(kColumns.map((name) => [name, new Float32Array(length)])) as Columns;
}
