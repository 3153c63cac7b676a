/** Texts as images: written once, then only copied while they stay the same. */

export interface TextLine {
  text: string;
  font: string;
  colour: string;
}

export interface TextImage {
  image: ImageBitmap;
  width: number;
  height: number;
}

export interface TextBox {
  lines: readonly TextLine[];
  width: number;
  height: number;
  background: string;
  padding_px: number;
  line_px: number;
}

export class TextImages {
  private known = new Map<string, TextImage>();
  private used = new Map<string, TextImage>();
  private readonly canvas = new OffscreenCanvas(1, 1);
  private readonly context: OffscreenCanvasRenderingContext2D;

  constructor(readonly ratio: number) {
    const context = this.canvas.getContext("2d");
    if (context === null) throw new Error("This browser has no canvas");
    this.context = context;
  }

  width(text: string, font: string): number {
    this.context.font = font;
    return this.context.measureText(text).width;
  }

  /** The same image for the same key: what it shows is part of the key. */
  get(key: string, box: () => TextBox): TextImage {
    let image = this.used.get(key) ?? this.known.get(key);
    image ??= this.write(box());
    this.used.set(key, image);
    return image;
  }

  /** Forgets what wasn't asked for since the last time. */
  sweep(): void {
    this.known = this.used;
    this.used = new Map();
  }

  private write(box: TextBox): TextImage {
    const { canvas, context, ratio } = this;
    canvas.width = Math.max(1, Math.ceil(box.width * ratio));
    canvas.height = Math.max(1, Math.ceil(box.height * ratio));
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = box.background;
    context.fillRect(0, 0, box.width, box.height);
    context.textBaseline = "top";
    box.lines.forEach(({ text, font, colour }, i) => {
      context.font = font;
      context.fillStyle = colour;
      context.fillText(text, box.padding_px, box.padding_px + i * box.line_px);
    });
    return {
      width: canvas.width / ratio,
      height: canvas.height / ratio,
      image: canvas.transferToImageBitmap(),
    };
  }
}
