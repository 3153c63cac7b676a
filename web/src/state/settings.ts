/** What a person chooses and this browser remembers. */
import { effect, signal } from "@preact/signals";
import { oneOf, remembered } from "./remembered";

export type ThemeChoice = "system" | "dark" | "light";
export type Theme = "dark" | "light";
export type AltitudeUnit = "m" | "ft";
export type DistanceUnit = "m" | "ft";
export type SpeedUnit = "m/s" | "km/h" | "kt";

export const theme_choice = remembered<ThemeChoice>("theme", "system", oneOf("system", "dark", "light"));
export const theme = signal<Theme>("dark");

export const altitude_unit = remembered<AltitudeUnit>("unit.altitude", "m", oneOf("m", "ft"));
export const distance_unit = remembered<DistanceUnit>("unit.distance", "m", oneOf("m", "ft"));
export const speed_unit = remembered<SpeedUnit>("unit.speed", "m/s", oneOf("m/s", "km/h", "kt"));

/** Keeps the document's theme in step with the choice and with the system. */
export function followTheme(): void {
  const system = matchMedia("(prefers-color-scheme: light)");
  const system_light = signal(system.matches);
  system.addEventListener("change", () => {
    system_light.value = system.matches;
  });
  effect(() => {
    const choice = theme_choice.value;
    const chosen = choice === "system" ? (system_light.value ? "light" : "dark") : choice;
    // The document first: who is told of the new theme reads its colours there.
    document.documentElement.dataset["theme"] = chosen;
    theme.value = chosen;
  });
}
