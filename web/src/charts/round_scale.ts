/** Where to cut a circle of `period` so that the fewest values are torn apart: opposite of their mean, in quarters. */
export function quietCut(values: Iterable<number>, period: number): number {
  let [x, y] = [0, 0];
  for (const value of values) {
    if (Number.isNaN(value)) continue;
    const angle = (value / period) * 2 * Math.PI;
    x += Math.cos(angle);
    y += Math.sin(angle);
  }
  const mean = (Math.atan2(y, x) / (2 * Math.PI)) * period;
  const quarter = period / 4;
  return Math.round((mean - period / 2) / quarter) * quarter;
}

/** `value` on the circle that begins at `cut`. */
export function fromCut(value: number, cut: number, period: number): number {
  const rest = (value - cut) % period;
  return cut + (rest < 0 ? rest + period : rest);
}
