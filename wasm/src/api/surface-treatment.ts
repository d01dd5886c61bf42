/** What becomes of the triangles of a surface before it is filled: kept, split or replaced. */
import { plural } from "../base/plural.js";
import { short } from "../base/short.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { PartialControl, RunControl } from "../engine/control.js";
import type { SurfaceInspection, SurfaceRefinement } from "../mesh/inspection.js";
import type { TriangleShapes } from "../mesh/triangle-shapes.js";
import type { RefinementCounts, RemeshReport } from "./meshed-surface.js";
import type { Mesher } from "./mesher-interface.js";
import type {
  MeshOptions,
  RefineOptions,
  RemeshOptions,
  RemeshSettings,
  SurfaceTreatment,
} from "./option-types.js";
import { inSteps } from "../calls/yielder.js";
import { harmfulNeedles } from "../mesh/quality-warnings.js";
import type { Mesh } from "../mesh/mesh.js";
import { type ElementShapes, poorNote } from "./poor-kept.js";
import type { Step } from "./whole-progress.js";

/** What was decided for a surface: never `auto`. */
export interface Treatment {
  readonly kind: Exclude<SurfaceTreatment, "auto"> | "smaller";
  /** Shapes of the triangles, if they are the reason for which all are replaced. */
  readonly needles?: TriangleShapes | undefined;
  /** Number of pairs of solids that touch or overlap and whose triangles do not fit together, if they are the reason. */
  readonly touching?: number | undefined;
  /** Shapes of the elements with the given triangles, if they are the reason. */
  readonly poor?: ElementShapes | undefined;
}

export interface TreatedSurface {
  readonly surface: Mesh;
  readonly refinement?: RefinementCounts;
  readonly remesh?: RemeshReport;
  /** Problems that prevent meshing. */
  readonly invalid?: readonly Diagnostic[];
  /** Warnings and notes. */
  readonly diagnostics?: readonly Diagnostic[];
}

/** Returns the control of the next call of a step; by default, of a run. */
export type ControlOf = (step?: Step) => RunControl;

export interface TreatmentOptions {
  readonly treatment: Treatment;
  readonly remeshing: RemeshSettings;
  /** Options of the mesh, including the background grid. */
  readonly options: MeshOptions;
  /** Factor on the automatic sizes of a remeshing. Default 1. */
  readonly sizeFactor?: number | undefined;
  readonly controlOf: ControlOf;
}

/** Returns the surface after its treatment. */
export async function treatedSurface(
  mesher: Mesher,
  given: Mesh,
  wanted: TreatmentOptions,
): Promise<TreatedSurface> {
  const { treatment } = wanted;
  switch (treatment.kind) {
    case "keep":
      return { surface: given, diagnostics: await inSteps(harmfulNeedles(given)) };
    case "remesh":
      return replaced(mesher, given, wanted);
    case "refine": {
      const { found, refine } = await inspected(mesher, given, wanted);
      return found.isFillable ? refine() : { surface: given, invalid: found.diagnostics };
    }
    case "smaller":
      return withSmallerTriangles(mesher, given, wanted);
  }
}

async function replaced(
  mesher: Mesher,
  given: Mesh,
  { treatment: { needles, touching, poor }, remeshing, options, sizeFactor, controlOf }: TreatmentOptions,
): Promise<TreatedSurface> {
  const { size, growth, maxVolume, innerShells, background } = options;
  const settings = needles && !hasSizes(options) ? withStatedSize(remeshing, needles) : remeshing;
  const all = { ...settings, size, sizeFactor, growth, maxVolume, innerShells, background };
  const made = await remeshed(mesher, given, all, { ...controlOf("remesh"), partial: true });
  const notes = [
    ...(needles === undefined ? [] : [needlesNote(needles)]),
    ...(touching === undefined ? [] : [touchingNote(touching)]),
    ...(poor === undefined ? [] : [poorNote(poor, KEEP)]),
  ];
  return { ...made, diagnostics: [...notes, ...made.diagnostics] };
}

/** Triangles that are replaced because of a few needles among them state the size that is wanted. */
const withStatedSize = (remeshing: RemeshSettings, { statedSize }: TriangleShapes): RemeshSettings =>
  statedSize === undefined ? remeshing : { ...remeshing, maxSize: remeshing.maxSize ?? statedSize };

export function hasSizes({ size, background, maxVolume }: MeshOptions): boolean {
  const sources = background?.sources ?? [];
  return (
    size !== undefined || maxVolume !== undefined || (background?.sizes.length ?? 0) > 0 || sources.length > 0
  );
}

/** Inspects before refining, so that diagnostics use the triangle indices of the given surface. */
async function inspected(
  mesher: Mesher,
  given: Mesh,
  { options, controlOf }: TreatmentOptions,
): Promise<{ readonly found: SurfaceInspection; readonly refine: () => ReturnType<typeof refined> }> {
  const { elements: _, threads: _threads, ...sizes } = options;
  const { innerShells } = sizes;
  const found = await mesher.inspectSurface(given, { innerShells }, controlOf("check"));
  // The volume helps to estimate the number of elements only if the orientation of all triangles is known.
  const volume = found.flippedTriangles === 0 ? found.volume : undefined;
  return { found, refine: () => refined(mesher, given, { ...sizes, volume }, controlOf("check")) };
}

/** Longest edge / target length up to which triangles are kept by default; with given sizes, `coarse-surface` warns above it. */
const MAX_LENGTH_RATIO = 2;

/** Returns whether triangles are far larger than the sizes that are given, or than those near them ask for. */
export const areTooLarge = ({ lengthRatio }: Pick<SurfaceRefinement, "lengthRatio">): boolean =>
  lengthRatio > MAX_LENGTH_RATIO;

/** Splits triangles that are too large. The run reports what is wrong with a surface that cannot be filled. */
async function withSmallerTriangles(
  mesher: Mesher,
  given: Mesh,
  treating: TreatmentOptions,
): Promise<TreatedSurface> {
  const { found, refine } = await inspected(mesher, given, treating);
  if (!found.isFillable) return { surface: given };
  const split = await refine();
  return areTooLarge(split.refinement)
    ? { ...split, diagnostics: [divided(split.refinement.lengthRatio, hasSizes(treating.options))] }
    : { surface: given };
}

const KEEP = 'Use `surface: "keep"` to keep them.';

function divided(lengthRatio: number, isGiven: boolean): Diagnostic {
  const ratio = short(lengthRatio, 2);
  const length = isGiven ? "the target length" : "the length that small triangles near them ask for";
  const message = `triangles had edges up to ${ratio} times ${length}, so they were split, as by \`surface: "refine"\``;
  return packageDiagnostic("divided-surface", message, KEEP, "information");
}

function needlesNote({ needles, triangles, smallestAngle }: TriangleShapes): Diagnostic {
  const message = `${needles} of ${plural(triangles, "triangle")} ${needles === 1 ? "was a needle" : "were needles"} (smallest angle ${short(smallestAngle, 2)}°), so all were replaced, as by \`surface: "remesh"\``;
  return packageDiagnostic("replaced-surface", message, KEEP, "information");
}

function touchingNote(pairs: number): Diagnostic {
  const message = `the triangles of ${plural(pairs, "pair")} of solids that touch or overlap do not fit together, so they were replaced, as by \`surface: "remesh"\``;
  return packageDiagnostic("replaced-surface", message, "", "information");
}

const countTriangles = ({ triangles }: Mesh) => triangles.length / 3;

export async function refined(
  mesher: Mesher,
  given: Mesh,
  options: RefineOptions,
  control: RunControl,
): Promise<{ readonly surface: Mesh; readonly refinement: RefinementCounts }> {
  const { mesh: surface, splitEdges, lengthRatio } = await mesher.refineSurface(given, options, control);
  const counts = { given: countTriangles(given), triangles: countTriangles(surface) };
  const refinement = { ...counts, splitEdges, lengthRatio };
  return { surface, refinement };
}

interface RemeshedSurface {
  readonly surface: Mesh;
  readonly remesh: RemeshReport;
  readonly diagnostics: readonly Diagnostic[];
}

export async function remeshed(
  mesher: Mesher,
  given: Mesh,
  options: RemeshOptions,
  control: PartialControl,
): Promise<RemeshedSurface> {
  const made = await mesher.remeshSurface(given, options, control);
  const { mesh: surface, origin: _origin, triangleDeviation: _deviation, diagnostics, ...figures } = made;
  const remesh = { given: countTriangles(given), triangles: countTriangles(surface), ...figures };
  return { surface, remesh, diagnostics };
}
