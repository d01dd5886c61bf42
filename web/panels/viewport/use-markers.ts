import { useLayoutEffect, useRef, type RefObject } from "react";
import type { Position } from "../../document/position";
import type { Viewer } from "../../viewer/viewer";
import { placedApart, type Label } from "../../viewer/apart";

/** Room that the text beside a marker needs at the right and below, in CSS pixels. */
const room = { right: 170, below: 110 };
/** The same beside the legend, which is at the right of a view of this width. */
const besideLegend = { right: 270, fromWidth: 600 };

/**
 * Keeps the children of an element at positions in the view. They follow the camera without rendering again. With `areApart`,
 * none lies on another one. At the right and lower edges of the view they have `data-at-right` and `data-at-bottom`: their texts
 * have room at the other side.
 */
export function useMarkers(
  viewer: Viewer,
  positions: readonly (Position | null)[],
  areApart = false,
): RefObject<HTMLDivElement | null> {
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    if (positions.length === 0) return undefined;
    const follow = (): void => {
      const shown: (Label & { readonly marker: HTMLElement })[] = [];
      const view = box.current?.parentElement?.getBoundingClientRect();
      positions.forEach((position, index) => {
        const marker = box.current?.children[index];
        if (!(marker instanceof HTMLElement) || !position) return;
        const at = viewer.toScreen(position);
        marker.style.display = at ? "" : "none";
        if (at && view) {
          const right = view.width < besideLegend.fromWidth ? room.right : besideLegend.right;
          marker.toggleAttribute("data-at-right", at.x > view.width - right);
          marker.toggleAttribute("data-at-bottom", at.y > view.height - room.below);
        }
        if (at) shown.push({ ...at, width: marker.offsetWidth, height: marker.offsetHeight, marker });
      });
      const places = areApart ? placedApart(shown) : shown;
      shown.forEach(({ marker }, i) => {
        const { x = 0, y = 0 } = places[i] ?? {};
        marker.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
      });
    };
    follow();
    return viewer.onDrawn(follow);
  });
  return box;
}
