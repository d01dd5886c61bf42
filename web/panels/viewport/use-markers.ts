import { useLayoutEffect, useRef, type RefObject } from "react";
import type { Position } from "../../document/position";
import type { Viewer } from "../../viewer/viewer";

/** Keeps the children of an element at positions in the view. They follow the camera without rendering again. */
export function useMarkers(
  viewer: Viewer,
  positions: readonly (Position | null)[],
): RefObject<HTMLDivElement | null> {
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const follow = (): void => {
      positions.forEach((position, index) => {
        const marker = box.current?.children[index];
        if (!(marker instanceof HTMLElement) || !position) return;
        const at = viewer.toScreen(position);
        marker.style.display = at ? "" : "none";
        if (at) marker.style.transform = `translate(${at.x}px, ${at.y}px) translate(-50%, -50%)`;
      });
    };
    follow();
    return viewer.onDrawn(follow);
  });
  return box;
}
