/** The time line as a person reads and uses it. */
import type { Locator } from "playwright-core";
import type { Screen } from "./screen";

export class TimeLine {
  readonly line: Locator;

  constructor(private readonly screen: Screen) {
    this.line = screen.page.getByRole("slider", { name: /^Time in the recording/ });
  }

  /** What it says is played [s]; NaN while that is only where a person wants to be. */
  async at_s(): Promise<number> {
    if ((await this.line.getAttribute("aria-busy")) !== "false") return NaN;
    const parts = (await this.screen.text(".transport-now")).split(":").map(Number);
    const [hours = NaN, minutes = NaN, seconds = NaN] = parts;
    return 3600 * hours + 60 * minutes + seconds;
  }

  async duration_s(): Promise<number> {
    return Number(await this.line.getAttribute("aria-valuemax"));
  }

  /** Where a part of the line (0..1) is on the screen. */
  async placeOf(part: number): Promise<{ x: number; y: number }> {
    const box = await this.line.boundingBox();
    if (box === null) throw new Error("the line isn't there");
    return { x: box.x + part * box.width, y: box.y + box.height / 2 };
  }

  async goTo(text: string): Promise<void> {
    const { keyboard } = this.screen.page;
    await keyboard.press("g");
    await keyboard.type(text);
    await keyboard.press("Enter");
  }
}
