/** Symbols as images: drawn once for each look they can have, then only copied. Filling paths is most of what a frame costs without a GPU. */
import type { Colours } from "./colours";
import { headingOf, headingStep, keyOf, type Detail } from "./looks";
import { kAircraft, kLeader, kLevelFrames, kSlot, kTraffic } from "./shapes";

export interface Sprite {
  image: ImageBitmap;
  /** Side of the square, in CSS pixels. */
  size: number;
}

const kScale: Record<Detail, number> = { full: 1, small: 0.6, dots: 0.3 };

export class Sprites {
  private readonly known = new Map<number, Sprite>();

  constructor(
    private readonly colours: Colours,
    /** Device pixels per CSS pixel. */
    readonly ratio: number,
  ) {}

  /** Copies a sprite with its middle at (x, y), on whole pixels: nothing is resampled. */
  put(context: CanvasRenderingContext2D, { image, size }: Sprite, x: number, y: number): void {
    const snap = (value: number) => Math.round((value - size / 2) * this.ratio) / this.ratio;
    context.drawImage(image, snap(x), snap(y), size, size);
  }

  aircraft(identity: number, lost: boolean, compass_rad: number, detail: Detail): Sprite {
    if (detail === "dots") return this.dot(identity, lost);
    const step = headingStep(compass_rad);
    return this.sprite(keyOf(lost ? 1 : 0, detail, identity, step), 34 * kScale[detail], (context) => {
      context.scale(kScale[detail], kScale[detail]);
      context.rotate(headingOf(step));
      this.body(context, kAircraft, identity, lost);
    });
  }

  /** Who flies in no formation: TCAS's "other traffic", an open diamond. */
  traffic(identity: number, lost: boolean, detail: Detail): Sprite {
    return this.sprite(keyOf(lost ? 3 : 2, detail, identity, 0), 34 * kScale[detail], (context) => {
      context.scale(kScale[detail], kScale[detail]);
      context.lineJoin = "round";
      context.setLineDash(lost ? [4, 3] : []);
      context.strokeStyle = this.colours.map_halo;
      context.lineWidth = 6;
      context.stroke(kTraffic);
      context.strokeStyle = this.identity(identity);
      context.lineWidth = 3;
      context.stroke(kTraffic);
    });
  }

  /** What stands behind an aircraft with a level, null for clear. */
  level(level: number, detail: Detail): Sprite | null {
    const shape = kLevelFrames[level] ?? null;
    if (shape === null) return null;
    return this.sprite(keyOf(4, detail, level, 0), 52 * kScale[detail], (context) => {
      context.scale(kScale[detail], kScale[detail]);
      context.strokeStyle = this.colours.map_halo;
      context.lineWidth = 4;
      context.stroke(shape);
      context.fillStyle = this.colours.level[level] ?? this.colours.text;
      context.fill(shape);
    });
  }

  slot(identity: number, flown: boolean, detail: Detail): Sprite {
    return this.sprite(keyOf(flown ? 5 : 6, detail, identity, 0), 32 * kScale[detail], (context) => {
      context.scale(kScale[detail], kScale[detail]);
      context.globalAlpha = flown ? 0.9 : 0.45;
      context.strokeStyle = this.identity(identity);
      context.lineWidth = 1.5 / kScale[detail];
      context.stroke(kSlot);
    });
  }

  leader(compass_rad: number, detail: Detail): Sprite {
    const step = headingStep(compass_rad);
    return this.sprite(keyOf(7, detail, 0, step), 26 * kScale[detail], (context) => {
      context.scale(kScale[detail], kScale[detail]);
      context.rotate(headingOf(step));
      context.strokeStyle = this.colours.text;
      context.lineWidth = 1.8;
      context.stroke(kLeader);
    });
  }

  /** The corners around a UAV that is selected. */
  brackets(): Sprite {
    return this.sprite(keyOf(8, "full", 0, 0), 56, (context) => {
      const [far, arm] = [26, 7];
      context.strokeStyle = this.colours.text;
      context.lineWidth = 1.5;
      context.beginPath();
      for (const x of [-1, 1]) {
        for (const y of [-1, 1]) {
          context.moveTo(x * far, y * (far - arm));
          context.lineTo(x * far, y * far);
          context.lineTo(x * (far - arm), y * far);
        }
      }
      context.stroke();
    });
  }

  private dot(identity: number, lost: boolean): Sprite {
    return this.sprite(keyOf(lost ? 9 : 10, "dots", identity, 0), 6, (context) => {
      context.fillStyle = this.colours.map_halo;
      context.fillRect(-3, -3, 6, 6);
      context.fillStyle = this.identity(identity);
      context.fillRect(-2, -2, 4, 4);
      if (lost) context.clearRect(-1, -1, 2, 2);
    });
  }

  private body(context: OffscreenContext, shape: Path2D, identity: number, lost: boolean): void {
    context.lineJoin = "round";
    context.strokeStyle = lost ? this.identity(identity) : this.colours.map_halo;
    context.lineWidth = lost ? 1.5 : 3;
    context.stroke(shape);
    context.fillStyle = lost ? this.colours.map_halo : this.identity(identity);
    context.fill(shape);
  }

  private identity(identity: number): string {
    return this.colours.identity[identity - 1] ?? this.colours.text;
  }

  /** Draws around (0, 0). */
  private sprite(key: number, size: number, draw: (context: OffscreenContext) => void): Sprite {
    const known = this.known.get(key);
    if (known !== undefined) return known;
    const pixels = Math.ceil(size * this.ratio);
    const canvas = new OffscreenCanvas(pixels, pixels);
    const context = canvas.getContext("2d");
    if (context === null) throw new Error("This browser has no canvas");
    context.setTransform(this.ratio, 0, 0, this.ratio, pixels / 2, pixels / 2);
    draw(context);
    const made = { image: canvas.transferToImageBitmap(), size: pixels / this.ratio };
    this.known.set(key, made);
    return made;
  }
}

type OffscreenContext = OffscreenCanvasRenderingContext2D;
