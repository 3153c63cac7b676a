/** Slots of a shape: the geometry of cpp/core/formation.*, held equal to it by tests/golden/shapes.csv. */

/** A place in a formation seen from the virtual leader [m]; forward, left and up are positive. */
export interface Offset {
  forward_m: number;
  left_m: number;
  up_m: number;
}

export const kShapes = [
  "triangle",
  "column",
  "line_abreast",
  "echelon_left",
  "echelon_right",
  "diamond",
  "vee",
] as const;
/** A custom formation has no slots of its own. */
export type Shape = (typeof kShapes)[number];

export const kShapeNames: Readonly<Record<Shape | "custom", string>> = {
  triangle: "Triangle",
  column: "Column",
  line_abreast: "Line abreast",
  echelon_left: "Echelon left",
  echelon_right: "Echelon right",
  diamond: "Diamond",
  vee: "Vee",
  custom: "Custom",
};

export function isShape(name: string): name is Shape {
  return (kShapes as readonly string[]).includes(name);
}

/** Slots for `count` UAVs, the first one `lead_m` behind the virtual leader and foremost; neighbours are at least `spacing_m` apart. */
export function shapeSlots(shape: Shape, count: number, spacing_m: number, lead_m: number): Offset[] {
  return unitSlots(shape, count, spacing_m).map((slot) => ({
    ...slot,
    forward_m: slot.forward_m - lead_m,
  }));
}

function unitSlots(shape: Shape, count: number, spacing_m: number): Offset[] {
  const diagonal_m = spacing_m * Math.SQRT1_2;
  switch (shape) {
    case "triangle":
      return rows(count, spacing_m, spacing_m, (spacing_m * Math.sqrt(3)) / 2, (row) => row + 1);
    case "column":
      return line(count, -spacing_m, 0);
    case "line_abreast":
      return rows(count, spacing_m, spacing_m, spacing_m, () => count);
    case "echelon_left":
      return line(count, -diagonal_m, diagonal_m);
    case "echelon_right":
      return line(count, -diagonal_m, -diagonal_m);
    case "diamond": {
      const widest = Math.ceil(Math.sqrt(count));
      return rows(count, spacing_m, spacing_m * Math.SQRT2, diagonal_m, (row) =>
        row < widest ? row + 1 : 2 * widest - 1 - row,
      );
    }
    case "vee":
      return vee(count, diagonal_m);
  }
}

/** One behind the other in steps. */
function line(count: number, forward_step_m: number, left_step_m: number): Offset[] {
  return Array.from({ length: count }, (_, i) => ({
    forward_m: i * forward_step_m,
    left_m: i * left_step_m,
    up_m: 0,
  }));
}

/** Leader first, then left and right in turn. */
function vee(count: number, step_m: number): Offset[] {
  return Array.from({ length: count }, (_, i) => {
    const rank_m = Math.floor((i + 1) / 2) * step_m;
    return { forward_m: -rank_m, left_m: i % 2 === 1 ? rank_m : -rank_m, up_m: 0 };
  });
}

/**
 * Centred rows; `sizeOf(row)` is how many a full row holds, the last one takes who is left. Where a row's places lie
 * between those of the row before, `between_m` behind keeps the spacing; where they lie behind them, it takes `spacing_m`.
 */
function rows(
  count: number,
  spacing_m: number,
  in_row_m: number,
  between_m: number,
  sizeOf: (row: number) => number,
): Offset[] {
  const slots: Offset[] = [];
  let forward_m = 0;
  let previous = 0;
  for (let row = 0; slots.length < count; row += 1) {
    const size = Math.min(count - slots.length, sizeOf(row));
    if (row > 0) forward_m -= (size - previous) % 2 !== 0 ? between_m : spacing_m;
    for (let i = 0; i < size; i += 1) {
      slots.push({ forward_m, left_m: ((size - 1) / 2 - i) * in_row_m, up_m: 0 });
    }
    previous = size;
  }
  return slots;
}
