/** Background grids as flat arrays, and the checks of their form. */
import * as v from "valibot";
import { plural } from "../base/plural.js";
import { asObject } from "../base/values.js";
import { doubles, integers, problemIn } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidArrays } from "../diagnostics/package-diagnostic.js";
import { sourceProblem } from "./schema.js";
import { type ProjectSource } from "./project-types.js";

const backgroundSchema = v.pipe(
  v.object({
    points: doubles(3),
    sizes: doubles(),
    stretchings: v.optional(doubles()),
    directions: v.optional(doubles(3)),
    secondStretchings: v.optional(doubles()),
    secondDirections: v.optional(doubles(3)),
    tetrahedra: integers(4),
    coverageMargin: v.optional(
      v.custom<number>((value) => Number.isFinite(value) && Number(value) >= 0, "a finite number from 0 on"),
    ),
  }),
  v.rawCheck(({ dataset, addIssue }) => {
    if (!dataset.typed) return;
    const { points, sizes, stretchings = sizes, directions = points } = dataset.value;
    const { secondStretchings = sizes, secondDirections = points } = dataset.value;
    const count = sizes.length;
    const fits =
      [stretchings, secondStretchings].every(({ length }) => length === count) &&
      [points, directions, secondDirections].every(({ length }) => length === 3 * count);
    if (!fits) {
      addIssue({ message: `its arrays do not fit its ${plural(count, "size")}` });
    }
  }),
);

/** Checks the form; the engine checks sizes, directions and tetrahedra, as for a project. */
export function checkBackground(background: BackgroundArrays): Diagnostic[] {
  const problem = problemIn(backgroundSchema, background);
  if (problem !== undefined) {
    const where = problem.path === "" ? "" : `.${problem.path}`;
    const remedy =
      "Pass x y z and a size per node, a stretching and x y z of its direction (also second ones) if needed, and four node indices per tetrahedron.";
    return [invalidArrays(`the background${where} is invalid: ${problem.message}`, remedy)];
  }
  const { sources = [] } = background;
  const wrong = sourceProblem(sources);
  if (wrong === undefined) return [];
  const remedy = "Pass sources as a project has them, with id, type, positions and size.";
  return [invalidArrays(`the sources of the background are invalid: ${wrong}`, remedy)];
}

/** Returns whether the background has no nodes: it then only caps other sizes around its sources. */
export function hasSourcesOnly(background: BackgroundArrays): boolean {
  const { tetrahedra, sizes } = asObject(background) as Partial<BackgroundArrays>;
  return tetrahedra?.length === 0 && sizes?.length === 0;
}

/** Background grid as flat arrays, for grids of any size, such as those of `backgroundFromMesh`. */
export interface BackgroundArrays {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Target edge length per node, above 0. */
  readonly sizes: Float64Array;
  /** Per node: target length along its direction / its size, at least 1. Default 1. */
  readonly stretchings?: Float64Array | undefined;
  /** x y z per node, of any length except 0. Required if a stretching is above 1. */
  readonly directions?: Float64Array | undefined;
  /** Per node: target length along its second direction / its size, at least 1. Default 1. */
  readonly secondStretchings?: Float64Array | undefined;
  /** x y z per node, orthogonal to its direction, of any length except 0. Required if a second stretching is above 1. */
  readonly secondDirections?: Float64Array | undefined;
  /** Four node indices per tetrahedron, in any orientation. */
  readonly tetrahedra: Uint32Array;
  /**
   * Margin outside the grid that counts as covered, as a fraction of the nearest tetrahedron's longest edge. Default 0.
   */
  readonly coverageMargin?: number | undefined;
  /** Sources, in addition to those of a project. For a given surface, nodes and tetrahedra may then be empty. */
  readonly sources?: readonly ProjectSource[] | undefined;
}
