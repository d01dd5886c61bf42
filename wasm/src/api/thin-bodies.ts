/** A note on bodies so thin that a single layer of good elements needs very many of them. */
import { short } from "../base/short.js";
import { type Steps, stepwise } from "../base/steps.js";
import { cornersOf, lengthOf, normalOf } from "../base/vectors.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { diagonalOf } from "../formats/near-points.js";
import type { SurfaceRemesh } from "../mesh/inspection.js";
import type { RemeshOptions } from "./option-types.js";

/** Number of triangles below which a mesh is made in seconds. */
const MANY_TRIANGLES = 100_000;
/** Mean thickness / diagonal above which other shapes have as many triangles too. */
const THIN = 1 / 300;
/** Number of significant digits of lengths and counts. */
const DIGITS = 2;

const REMEDY =
  "For fewer, ask for a number (`elements`), permit flat elements (`layers: 0`), or compute the part with shell elements.";

/** Returns a note about a remeshed body with automatic sizes, if it is thin and its triangles are very many. O(n). */
export function* thinBodyNotes(
  { mesh, volume }: Pick<SurfaceRemesh, "mesh" | "volume">,
  { size, background, layers }: RemeshOptions,
): Steps<Diagnostic[]> {
  const isChosen = size !== undefined || background !== undefined || layers !== undefined;
  const count = mesh.triangles.length / 3;
  if (isChosen || count < MANY_TRIANGLES) return [];
  let area = 0;
  yield* stepwise(count, (t) => {
    area += lengthOf(normalOf(cornersOf(mesh, t))) / 2;
  });
  const [thickness, diagonal] = [(2 * Math.abs(volume)) / area, diagonalOf(mesh.points)];
  if (!(thickness < THIN * diagonal)) return [];
  const message = `the body is about ${short(thickness, DIGITS)} thick and ${short(diagonal, DIGITS)} large, so that one layer of good elements takes ${count} triangles, and more elements`;
  return [packageDiagnostic("thin-body", message, REMEDY, "information")];
}
