import type { PlanePoint } from "../../kit/plane-view";

/** The shapes with which a figure begins, counter-clockwise, within 1.4 by 1. */
export const shapes: Readonly<Record<string, readonly PlanePoint[]>> = {
  boot: [
    [0.04, 0.12],
    [0.55, 0.05],
    [1.22, 0.1],
    [1.36, 0.42],
    [1.02, 0.6],
    [0.78, 0.5],
    [0.66, 0.94],
    [0.2, 0.9],
    [0.3, 0.5],
  ],
  fish: [
    [0.05, 0.2],
    [0.5, 0.06],
    [1.05, 0.12],
    [1.36, 0.44],
    [1.08, 0.84],
    [0.66, 0.72],
    [0.4, 0.95],
    [0.06, 0.82],
    [0.27, 0.5],
  ],
};
