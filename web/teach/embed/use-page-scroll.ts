import { useEffect, useState, type RefObject } from "react";
import type { Viewer } from "../../viewer/viewer";

/** How long the hint is shown after the last turn of the wheel, in milliseconds. */
const hintMs = 1500;

/**
 * Leaves the wheel, and vertical motions of a finger, to the page in which the view is embedded: who scrolls past must not be caught.
 * With Ctrl, the wheel zooms the view. Returns whether to say so.
 */
export function usePageScroll(container: RefObject<HTMLElement | null>, viewer: Viewer | null): boolean {
  const [isHinted, setHinted] = useState(false);
  useEffect(() => {
    const box = container.current;
    if (!box || !viewer) return undefined;
    let timer: ReturnType<typeof setTimeout> | undefined;
    // The camera listens at the canvas and would prevent the scroll.
    const onWheel = (event: WheelEvent): void => {
      if (event.ctrlKey || event.metaKey) return;
      event.stopPropagation();
      setHinted(true);
      clearTimeout(timer);
      timer = setTimeout(() => setHinted(false), hintMs);
    };
    box.addEventListener("wheel", onWheel, { capture: true, passive: true });
    const canvas = box.querySelector("canvas");
    if (canvas) canvas.style.touchAction = "pan-y";
    return () => {
      clearTimeout(timer);
      box.removeEventListener("wheel", onWheel, { capture: true });
    };
  }, [container, viewer]);
  return isHinted;
}
