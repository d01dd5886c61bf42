import type { Project } from "tetrafront/project";
import { entityKey } from "../../document/entities";
import type { Label } from "../../viewer/apart";
import type { ScreenPoint } from "../../viewer/screen";

/** Largest number of points that are numbered: more would hide the model. */
const maxNumbers = 300;

/** Returns the points whose numbers are shown. */
export const numberedPoints = (points: Project["points"], hidden: ReadonlySet<string>): Project["points"] =>
  points.filter(({ id }) => !hidden.has(entityKey({ kind: "point", id }))).slice(0, maxNumbers);

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
