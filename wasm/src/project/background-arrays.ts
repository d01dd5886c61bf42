/** Background grids as flat arrays, and the checks of their form. */
import { plural } from "../base/plural.js";
import { asObject, GONE, isArrayOf, isFiniteFrom, isUsable, shown } from "../base/values.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidArrays } from "../diagnostics/package-diagnostic.js";
import { type ProjectSource, sourceProblem } from "./schema.js";

const SOURCES_WANTED = "Give sources as a project has them: id, type, places and size each.";

/** The form alone: sizes, directions and tetrahedra are the engine's to judge, as in a project. */
export function checkBackground(background: BackgroundArrays): Diagnostic[] {
  const {
    points,
    sizes,
    stretchings,
    directions,
    tetrahedra,
    coverageMargin = 0,
    sources = [],
  } = asObject(background);
  const isOptional = (array: unknown) => array === undefined || isUsable(Float64Array, array);
  if (
    !(isUsable(Float64Array, points) && isUsable(Float64Array, sizes) && isUsable(Uint32Array, tetrahedra)) ||
    !(isOptional(stretchings) && isOptional(directions))
  ) {
    return [
      gridProblem(
        "the background grid's points, sizes, stretchings and directions are not Float64Arrays, " +
          `or its tetrahedra no Uint32Array${GONE}`,
      ),
    ];
  }
  const count = sizes.length;
  const hasLength = (array: unknown, length: number) =>
    !isArrayOf(Float64Array, array) || array.length === length;
  if (
    !hasLength(points, 3 * count) ||
    !hasLength(stretchings, count) ||
    !hasLength(directions, 3 * count) ||
    tetrahedra.length % 4 !== 0
  ) {
    return [gridProblem(`the arrays of the background grid do not fit its ${plural(count, "size")}`)];
  }
  if (!isFiniteFrom(0, coverageMargin)) {
    return [
      invalidArrays(`coverageMargin is ${shown(coverageMargin)}`, "Give a finite number of 0 or more."),
    ];
  }
  const problem = sourceProblem(sources);
  if (problem !== undefined) {
    return [invalidArrays(`the background grid's sources do not fit: ${problem}`, SOURCES_WANTED)];
  }
  return [];
}

function gridProblem(message: string): Diagnostic {
  return invalidArrays(
    message,
    "Give x y z and a size per node, a stretching and x y z of its direction if need be, and four node positions per tetrahedron.",
  );
}

/** Then it leaves the sizes that there are, and only cuts them down around its sources. */
export function hasSourcesOnly(background: BackgroundArrays): boolean {
  const { tetrahedra, sizes } = asObject(background) as Partial<BackgroundArrays>;
  return tetrahedra?.length === 0 && sizes?.length === 0;
}

/**
 * A background grid as flat arrays: what a generated mesh becomes (`backgroundFromMesh`), at full speed
 * also with hundreds of thousands of tetrahedra.
 */
export interface BackgroundArrays {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Wanted edge length per node, above 0. */
  readonly sizes: Float64Array;
  /** Per node: wanted length along its direction divided by its size, 1 or more. Default 1. */
  readonly stretchings?: Float64Array | undefined;
  /** x y z per node, of any length but 0. Needed where a stretching is above 1. */
  readonly directions?: Float64Array | undefined;
  /** Four node positions per tetrahedron, in any orientation. */
  readonly tetrahedra: Uint32Array;
  /** What this far outside still counts as covered, as in `ProjectBackground`. Default 0. */
  readonly coverageMargin?: number | undefined;
  /** In addition to those of a project. For a given surface they may be all there is. */
  readonly sources?: readonly ProjectSource[] | undefined;
}
