import { afterEach, expect, test } from "vitest";
import { altitude_unit, distance_unit, speed_unit } from "../state/settings";
import { inChosenUnits } from "./station_text";

afterEach(() => {
  altitude_unit.value = "m";
  distance_unit.value = "m";
  speed_unit.value = "m/s";
});

const kClimb = "climbing 200 m (8 m to go): link of UAV3 lost";
const kPair = "UAV1 and UAV4: warning, R 120 m, H 30 m, Tau 12 s";

test("in metres a text stays as it is, letter by letter", () => {
  for (const text of [kClimb, kPair, "passes 1.2 km ahead at 50.5 m/s"])
    expect(inChosenUnits(text)).toBe(text);
});

test("heights follow the unit of altitudes, other lengths that of distances", () => {
  altitude_unit.value = "ft";
  expect(inChosenUnits(kClimb)).toBe("climbing 656 ft (26 ft to go): link of UAV3 lost");
  expect(inChosenUnits(kPair)).toBe("UAV1 and UAV4: warning, R 120 m, H 98 ft, Tau 12 s");
  expect(inChosenUnits("200 m above the planned altitude")).toBe("656 ft above the planned altitude");
  distance_unit.value = "ft";
  expect(inChosenUnits(kPair)).toBe("UAV1 and UAV4: warning, R 394 ft, H 98 ft, Tau 12 s");
  expect(inChosenUnits("the slots are 100 m apart and 20 m in height")).toBe(
    "the slots are 328 ft apart and 66 ft in height",
  );
  expect(inChosenUnits("the leader is 5.2 km away")).toBe("the leader is 2.8 NM away");
});

test("speeds follow their unit", () => {
  speed_unit.value = "kt";
  expect(inChosenUnits("flies at 50.0 m/s, accelerates with 2 m/s²")).toBe(
    "flies at 97.2 kt, accelerates with 2 m/s²",
  );
});

test("ids, callsigns and other numbers are no quantities", () => {
  altitude_unit.value = distance_unit.value = "ft";
  for (const text of [
    "acknowledged by Ann: link of UAV-3 m lost",
    "UAV2m: nothing heard for 4.0 s",
    "alarm 17 was acknowledged before",
    "2 more at the same time",
    "5 members",
  ])
    expect(inChosenUnits(text)).toBe(text);
});
