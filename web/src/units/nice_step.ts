/** The nearest of 1, 2, 5, 10, ... that is not less than `value`. */
export function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const steps = [1, 2, 5, 10];
  return power * (steps.find((step) => step * power >= value * (1 - 1e-9)) ?? 10);
}
