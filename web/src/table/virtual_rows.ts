import { elementScroll, observeElementOffset, observeElementRect, Virtualizer } from "@tanstack/virtual-core";
import type { RefObject } from "preact";
import { useLayoutEffect, useReducer, useRef, useState } from "preact/hooks";

export const kRowHeight_px = 32;
/** The head stands over the first rows of what is scrolled to. */
export const kHeadHeight_px = 38;
const kOverscan = 4;

export interface PlacedRow {
  index: number;
  top_px: number;
  /** Which of the reused elements shows it. */
  element: number;
}

export interface VirtualRows {
  rows: readonly PlacedRow[];
  total_px: number;
  /** Brings a row into view. */
  reveal: (index: number) => void;
}

/** The rows in view out of `count`: scrolling reuses their elements. */
export function useVirtualRows(scroller: RefObject<HTMLElement | null>, count: number): VirtualRows {
  const redraw = useReducer((drawn: number) => drawn + 1, 0)[1] as () => void;
  const most = useRef(1);
  const options = {
    count,
    getScrollElement: () => scroller.current,
    estimateSize: () => kRowHeight_px,
    overscan: kOverscan,
    scrollPaddingEnd: kHeadHeight_px,
    scrollToFn: elementScroll,
    observeElementRect,
    observeElementOffset,
    onChange: redraw,
  };
  const [virtualizer] = useState(() => new Virtualizer<HTMLElement, HTMLElement>(options));
  virtualizer.setOptions(options);
  useLayoutEffect(() => virtualizer._didMount(), [virtualizer]);
  useLayoutEffect(() => {
    virtualizer._willUpdate();
  });
  const items = virtualizer.getVirtualItems();
  most.current = Math.max(most.current, items.length);
  return {
    rows: items.map(({ index, start }) => ({ index, top_px: start, element: index % most.current })),
    total_px: virtualizer.getTotalSize(),
    reveal: (index) => {
      virtualizer.scrollToIndex(index, { align: "auto" });
    },
  };
}
