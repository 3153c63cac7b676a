import type { Signal } from "@preact/signals";

interface SplitterProps {
  /** Of the panel whose size it changes. */
  label: string;
  size_px: Signal<number>;
  least_px: number;
  most_px: number;
  /** On which edge of its panel it is. */
  edge: "left" | "right" | "top";
}

const kStep_px = 16;

/** The edge of a panel, dragged or moved with the arrow keys. */
export function Splitter({ label, size_px, least_px, most_px, edge }: SplitterProps) {
  const upright = edge !== "top";
  // Which way is larger: away from the panel.
  const sign = edge === "right" ? 1 : -1;
  const set = (size: number) => {
    size_px.value = Math.round(Math.min(Math.max(size, least_px), most_px));
  };
  const drag = (down: PointerEvent) => {
    const handle = down.currentTarget as HTMLElement;
    const start_px = size_px.peek();
    handle.setPointerCapture(down.pointerId);
    const move = (event: PointerEvent) => {
      set(start_px + sign * (upright ? event.clientX - down.clientX : event.clientY - down.clientY));
    };
    const end = () => {
      handle.removeEventListener("pointermove", move);
    };
    handle.addEventListener("pointermove", move);
    handle.addEventListener("lostpointercapture", end, { once: true });
    down.preventDefault();
  };
  const press = (event: KeyboardEvent) => {
    const [larger, smaller] = { right: ["Right", "Left"], left: ["Left", "Right"], top: ["Up", "Down"] }[
      edge
    ];
    if (event.key === `Arrow${larger}`) set(size_px.peek() + kStep_px);
    else if (event.key === `Arrow${smaller}`) set(size_px.peek() - kStep_px);
    else return;
    event.preventDefault();
  };
  return (
    <div
      class={`splitter ${edge}`}
      role="separator"
      tabIndex={0}
      aria-label={label}
      aria-orientation={upright ? "vertical" : "horizontal"}
      aria-valuenow={size_px.value}
      aria-valuemin={least_px}
      aria-valuemax={most_px}
      onPointerDown={drag}
      onKeyDown={press}
    />
  );
}
