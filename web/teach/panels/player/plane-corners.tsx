import type { PlanarFront } from "tetrafront/trace";
import { useMemo } from "react";
import { cornersOfPlane } from "../../player/plane-drawing";
import styles from "./plane-view.module.css";

/** Distance of a label from its corner, and height of its letter, as shares of the drawing. */
const distance = 0.032;
const letter = 0.038;

/** The letters A to D at the corners of the mapping, outside the patch. `size`: width of the drawing. */
export function PlaneCorners({ front, size }: { readonly front: PlanarFront; readonly size: number }) {
  const corners = useMemo(() => cornersOfPlane(front), [front]);
  const middle = [0, 1].map(
    (axis) => corners.reduce((sum, { at }) => sum + (at[axis] ?? 0), 0) / corners.length,
  );
  return corners.map(({ name, at: [x, y] }) => {
    const [dx, dy] = [x - (middle[0] ?? 0), y - (middle[1] ?? 0)];
    const scale = (distance * size) / Math.hypot(dx, dy);
    return (
      <text
        key={name}
        className={styles["corner"]}
        transform={`translate(${x + scale * dx} ${y + scale * dy}) scale(1 -1)`}
        fontSize={letter * size}
      >
        {name}
      </text>
    );
  });
}
