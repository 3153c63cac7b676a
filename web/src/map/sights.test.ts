import { expect, test, vi } from "vitest";
import { kHasSlot } from "../link/frames";
import { kLinkLost } from "../state/fleet";
import { motionFrame, statusFrame } from "../state/frames_for_tests";
import { Store } from "../state/store";
import { localFrame } from "../units/geodesy";
import { Sights } from "./sights";
import { mercatorX, mercatorY, type View } from "./view";

vi.hoisted(() => {
  // Symbols are paths of the browser's.
  vi.stubGlobal("Path2D", Object);
});

const frame = localFrame({ latitude_deg: 40, longitude_deg: 116, altitude_m: 0 });
const scale_px = 1e6;
/** The origin is in the middle. */
const view: View = {
  scale_px,
  left_px: mercatorX(116) * scale_px - 500,
  top_px: mercatorY(40) * scale_px - 300,
  width_px: 1000,
  height_px: 600,
};

test("a flight that begins anew is not judged by what was thought of the last one", () => {
  const store = new Store(() => undefined);
  const sights = new Sights();
  store.takeFrame(motionFrame([1, 2]), 0);
  store.takeFrame(
    statusFrame([1, 2], {
      level: Uint8Array.of(3, 0),
      level_with_id: Int32Array.of(2, 0),
      downlink: Uint8Array.of(kLinkLost, 0),
      horizontal_uncertainty_m: Float32Array.of(50, 0),
      flags: Uint8Array.of(kHasSlot, 0),
    }),
    0,
  );
  sights.look(store, view, frame, 0);
  expect(sights.get(1)).toMatchObject({ level: 3, threat_id: 2, lost: true, uncertainty_m: 50 });
  store.fleet.clear();
  store.takeFrame(motionFrame([1, 2], { utime: 2e15 }), 0);
  sights.look(store, view, frame, 0);
  expect(sights.get(1)).toMatchObject({ level: 0, threat_id: 0, lost: false, uncertainty_m: 0 });
});

test("who is far away is not drawn, and doesn't count for how fast things move", () => {
  const store = new Store(() => undefined);
  const sights = new Sights();
  store.takeFrame(
    motionFrame([1, 2], { east_m: Float32Array.of(0, 1e6), speed_m_s: Float32Array.of(40, 90) }),
    0,
  );
  sights.look(store, view, frame, 0);
  expect(sights.visible.map(({ id }) => id)).toEqual([1]);
  expect(sights.get(1)?.x).toBeCloseTo(500, 3);
  expect(sights.fastest_m_s).toBe(40);
});
