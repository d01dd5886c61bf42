import type { Label } from "../../viewer/apart";
import type { ScreenPoint } from "../../viewer/screen";

/** Largest number of points that are numbered: more would hide the model. */
export const maxNumbers = 300;

/** Size of the number of a point in CSS pixels: of each digit, and how far its middle is at the right of the point. */
const digit = { width: 6.5, height: 13 };
const aside = 9;

/** Returns where the number of a point is drawn: see `.number` in drawing.module.css. */
export const numberLabel = (id: number, { x, y }: ScreenPoint): Label => ({
  x: x + aside,
  y,
  width: digit.width * String(id).length,
  height: digit.height,
});
