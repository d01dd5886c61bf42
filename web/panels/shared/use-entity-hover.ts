import { useEffect, useRef } from "react";
import type { Entity } from "../../document/entities";
import { useApp } from "./app-context";

/**
 * Returns the listeners of an element that stands for an entity: the view highlights it while the pointer is over the element.
 * An element that is removed under the pointer gets no event: then the highlight ends, too.
 */
export function useEntityHover(entity: Entity) {
  const { view } = useApp();
  const isOver = useRef(false);
  const set = (isNowOver: boolean): void => {
    isOver.current = isNowOver;
    view.setHover(isNowOver ? entity : null);
  };
  useEffect(
    () => () => {
      if (isOver.current) view.setHover(null);
    },
    [view],
  );
  return { onMouseEnter: () => set(true), onMouseLeave: () => set(false) };
}
