/** A note on bodies so thin that a single layer of good elements needs very many of them. */
import { short } from "../base/short.js";
import { type Steps, stepwise } from "../base/steps.js";
import { cornersOf, lengthOf, normalOf } from "../base/vectors.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { diagonalOf } from "../formats/near-points.js";
import type { SurfaceRemesh } from "../mesh/inspection.js";
import type { Mesh } from "../mesh/mesh.js";
import type { RemeshOptions } from "./option-types.js";

/** Number of triangles below which a mesh is made in seconds. */
const MANY_TRIANGLES = 100_000;
/** Mean thickness / diagonal above which other shapes have as many triangles too. */
const THIN = 1 / 300;
/** Size of the triangles of one layer / thickness, as the remeshing chooses it for discs. */
const SIZE_PER_THICKNESS = 4.3;
/** Area of an equilateral triangle / squared size. */
const AREA_PER_SQUARE = Math.sqrt(3) / 4;
/** Number of significant digits of lengths and counts. */
const DIGITS = 2;

const REMEDY =
  "For fewer, ask for a number (`elements`), permit flat elements (`layers: 0`), or compute the part with shell elements.";

type ChosenSizes = Pick<RemeshOptions, "size" | "background" | "layers">;

/** Returns a note about a remeshed body with automatic sizes, if it is thin and its triangles are very many. O(n). */
export function* thinBodyNotes(
  { mesh, volume }: Pick<SurfaceRemesh, "mesh" | "volume">,
  options: ChosenSizes,
): Steps<Diagnostic[]> {
  const count = mesh.triangles.length / 3;
  if (areChosen(options) || count < MANY_TRIANGLES) return [];
  const { area } = yield* measuresOf(mesh);
  return notesOf(mesh, (2 * Math.abs(volume)) / area, String(count));
}

/**
 * Returns the note before a surface is remeshed, which takes long, with an estimate of the triangles. None if the surface does not
 * enclose a thin body, or if that takes few triangles. O(n).
 */
export function* expectedThinNotes(mesh: Mesh, options: ChosenSizes): Steps<Diagnostic[]> {
  if (areChosen(options)) return [];
  const { area, volume } = yield* measuresOf(mesh);
  const thickness = (2 * Math.abs(volume)) / area;
  const count = area / (AREA_PER_SQUARE * (SIZE_PER_THICKNESS * thickness) ** 2);
  if (!(count >= MANY_TRIANGLES)) return [];
  return notesOf(mesh, thickness, `about ${countText(count)}`);
}

const areChosen = ({ size, background, layers }: ChosenSizes): boolean =>
  size !== undefined || background !== undefined || layers !== undefined;

/** Returns the area and the enclosed volume, relative to the first node. O(n). */
function* measuresOf(mesh: Pick<Mesh, "points" | "triangles">): Steps<{ area: number; volume: number }> {
  let [area, volume] = [0, 0];
  const [x = 0, y = 0, z = 0] = mesh.points;
  yield* stepwise(mesh.triangles.length / 3, (t) => {
    const corners = cornersOf(mesh, t);
    const normal = normalOf(corners);
    area += lengthOf(normal) / 2;
    const [a] = corners;
    volume += ((a[0] - x) * normal[0] + (a[1] - y) * normal[1] + (a[2] - z) * normal[2]) / 6;
  });
  return { area, volume };
}

function notesOf({ points }: Pick<Mesh, "points">, thickness: number, count: string): Diagnostic[] {
  const diagonal = diagonalOf(points);
  if (!(thickness < THIN * diagonal)) return [];
  const message = `the body is about ${short(thickness, DIGITS)} thick and ${short(diagonal, DIGITS)} large, so that one layer of good elements takes ${count} triangles, and more elements`;
  return [packageDiagnostic("thin-body", message, REMEDY, "information")];
}

/** Returns a count with one significant digit. */
function countText(count: number): string {
  const digit = 10 ** Math.floor(Math.log10(count));
  return String(Math.round(count / digit) * digit);
}
