import type { RefObject } from "preact";
import { useLayoutEffect, useState } from "preact/hooks";

/** Width of an element, without its scroll bar, as it changes. */
export function useWidth(element: RefObject<HTMLElement | null>): number {
  const [width_px, setWidth] = useState(0);
  useLayoutEffect(() => {
    const watched = element.current;
    if (watched === null) return;
    const observer = new ResizeObserver(() => {
      setWidth(watched.clientWidth);
    });
    observer.observe(watched);
    setWidth(watched.clientWidth);
    return () => {
      observer.disconnect();
    };
  }, [element]);
  return width_px;
}
