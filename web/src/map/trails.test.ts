import { expect, test, vi } from "vitest";
import { Fleet } from "../state/fleet";
import { motionFrame } from "../state/frames_for_tests";
import { localFrame } from "../units/geodesy";
import { Trails } from "./trails";
import { xOf, mercatorX, type View } from "./view";

const frame = localFrame({ latitude_deg: 0, longitude_deg: 0, altitude_m: 0 });
const view: View = { scale_px: 40_075_017, left_px: 0, top_px: 0, width_px: 1, height_px: 1 };

/** Keeps what is drawn: "M" and "L" with metres east. */
class FakePath {
  static drawn: string[] = [];
  moveTo(x: number): void {
    FakePath.drawn.push(`M${metres(x)}`);
  }
  lineTo(x: number): void {
    FakePath.drawn.push(`L${metres(x)}`);
  }
}
const metres = (x: number) => Math.round(x - xOf(view, mercatorX(0)));

/** Flies east at 50 m/s; heard at these seconds. */
function drawnOf(seconds: readonly number[]): string[] {
  const trails = new Trails();
  const fleet = new Fleet();
  for (const t_s of seconds) {
    fleet.take(motionFrame([1], { utime: 1e15 + t_s * 1e6, east_m: Float32Array.of(50 * t_s) }), 0);
    trails.sample(fleet, frame);
  }
  FakePath.drawn = [];
  vi.stubGlobal("Path2D", FakePath);
  trails.draw(
    { stroke: () => undefined } as unknown as CanvasRenderingContext2D,
    view,
    { ids: [1], length_min: 30 },
    () => 1,
    ["black"],
  );
  vi.unstubAllGlobals();
  return FakePath.drawn;
}

test("a straight flight has a point every ten seconds", () => {
  expect(drawnOf([0, 2, 5, 10, 15, 20])).toEqual(["M0", "L500", "L1000"]);
});

test("where nothing was heard, there is no trail", () => {
  expect(drawnOf([0, 10, 40, 50])).toEqual(["M0", "L500", "M2000", "L2500"]);
});

test("a recording that is wound back takes the trail along", () => {
  expect(drawnOf([0, 10, 20, 30, 12, 22])).toEqual(["M0", "L500", "L1100"]);
});
