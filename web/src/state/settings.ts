/** What a person chooses and this browser remembers. */
import { effect, signal } from "@preact/signals";

export type ThemeChoice = "system" | "dark" | "light";
export type Theme = "dark" | "light";

const kThemeKey = "skein.theme";

export const theme_choice = signal<ThemeChoice>(readChoice());
export const theme = signal<Theme>("dark");

function readChoice(): ThemeChoice {
  const kept = localStorage.getItem(kThemeKey);
  return kept === "dark" || kept === "light" ? kept : "system";
}

/** Keeps the document's theme in step with the choice and with the system. */
export function followTheme(): void {
  const system = matchMedia("(prefers-color-scheme: light)");
  const system_light = signal(system.matches);
  system.addEventListener("change", () => {
    system_light.value = system.matches;
  });
  effect(() => {
    const choice = theme_choice.value;
    if (choice === "system") localStorage.removeItem(kThemeKey);
    else localStorage.setItem(kThemeKey, choice);
    const chosen = choice === "system" ? (system_light.value ? "light" : "dark") : choice;
    // The document first: who is told of the new theme reads its colours there.
    document.documentElement.dataset["theme"] = chosen;
    theme.value = chosen;
  });
}
