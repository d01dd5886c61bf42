/** The polygon whose front the heap of lesson 8 holds; sides are shortest at its first corner. */
import type { PlanePoint } from "../../kit/plane-view";

export const heapShape: readonly PlanePoint[] = [
  [0.2, 0.16],
  [0.62, 0.06],
  [0.95, 0.34],
  [0.86, 0.86],
  [0.46, 0.94],
  [0.06, 0.64],
];
export const heapSize = 0.2;
