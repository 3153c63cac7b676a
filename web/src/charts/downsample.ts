/** Fewer points for drawing: of what falls into one pixel's width, the least and the greatest, so that no peak is lost. */

export interface Drawn {
  t_s: number[];
  /** Null: a gap. */
  values: (number | null)[][];
}

export interface Curve {
  values: Float32Array;
  /** Of an angle: how long once round is. A curve that goes round is cut instead of drawn across. */
  period?: number;
}

/** The samples `first` .. `end` (not included) of each curve, at most `most` points; two a bucket share a time. */
export function downsample(
  t_s: Float64Array,
  curves: readonly Curve[],
  first: number,
  end: number,
  most: number,
): Drawn {
  const count = end - first;
  if (count <= most) {
    return {
      t_s: [...t_s.subarray(first, end)],
      values: curves.map((curve) => exactly(curve, first, end)),
    };
  }
  const buckets = Math.max(1, Math.floor(most / 2));
  const drawn: Drawn = { t_s: [], values: curves.map(() => []) };
  for (let bucket = 0; bucket < buckets; bucket += 1) {
    const from = first + Math.floor((bucket * count) / buckets);
    const to = first + Math.floor(((bucket + 1) * count) / buckets);
    // The bucket's own first and last time: what is drawn is never outside of what was sampled.
    drawn.t_s.push(t_s[from] ?? 0, t_s[to - 1] ?? 0);
    curves.forEach((curve, i) => {
      drawn.values[i]?.push(...extremes(curve, from, to, bucket === 0));
    });
  }
  return drawn;
}

function exactly({ values, period }: Curve, first: number, end: number): (number | null)[] {
  const result: (number | null)[] = [];
  for (let i = first; i < end; i += 1) {
    result.push(i > first && wraps(values, i, period) ? null : orGap(values[i]));
  }
  return result;
}

/** Least and greatest, the earlier one first. */
function extremes(
  { values, period }: Curve,
  from: number,
  to: number,
  is_first: boolean,
): [number | null, number | null] {
  let least = -1;
  let greatest = -1;
  for (let i = from; i < to; i += 1) {
    const value = values[i] ?? NaN;
    if (Number.isNaN(value)) continue;
    if ((i > from || !is_first) && wraps(values, i, period)) return [null, orGap(values[to - 1])];
    if (least < 0 || value < (values[least] ?? 0)) least = i;
    if (greatest < 0 || value > (values[greatest] ?? 0)) greatest = i;
  }
  if (least < 0) return [null, null];
  const pair: [number, number] = least < greatest ? [least, greatest] : [greatest, least];
  return [orGap(values[pair[0]]), orGap(values[pair[1]])];
}

function wraps(values: Float32Array, i: number, period: number | undefined): boolean {
  return period !== undefined && Math.abs((values[i] ?? 0) - (values[i - 1] ?? 0)) > period / 2;
}

function orGap(value: number | undefined): number | null {
  return value === undefined || Number.isNaN(value) ? null : value;
}
