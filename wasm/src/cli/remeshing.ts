/** The treatment of a given surface before it is meshed: `--surface keep`, `refine` or `remesh`. */
import type { Mesher } from "../api/mesher-interface.js";
import type { MeshOptions, RefineOptions, RemeshOptions } from "../api/option-types.js";
import { checkRemeshOptions } from "../api/options.js";
import { repairedSurface } from "../api/repaired-surface.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type { PartialControl, RunControl } from "../engine/control.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { SurfaceRemesh } from "../mesh/inspection.js";
import { numberIn, refuseOptions } from "./input.js";
import { short } from "./tables.js";

export const SURFACE_TREATMENTS = ["keep", "refine", "remesh"] as const;
export type SurfaceTreatment = (typeof SURFACE_TREATMENTS)[number];

/** Options of a remeshing as commander passes them, without those of the sizes. */
export interface RemeshCommandOptions {
  readonly minSize?: string;
  readonly maxSize?: string;
  readonly tolerance?: string;
  readonly featureAngle?: string;
  readonly anglePerEdge?: string;
  readonly layers?: string;
  readonly dropDetails?: string;
}

/** The options by their names in the call, as they are written on the command line. */
const WRITTEN = {
  minSize: "--min-size",
  maxSize: "--max-size",
  tolerance: "--tolerance",
  featureAngle: "--feature-angle",
  anglePerEdge: "--angle-per-edge",
  layers: "--layers",
  dropDetails: "--drop-details",
} as const satisfies Record<keyof RemeshCommandOptions, string>;

/** Returns the options of a remeshing with these sizes. Throws an InvalidInput if one is invalid. */
export function remeshOptions(
  given: RemeshCommandOptions,
  { size, growth, maxVolume, innerShells, background }: MeshOptions,
): RemeshOptions {
  const options: RemeshOptions = {
    size,
    growth,
    maxVolume,
    innerShells,
    background,
    minSize: numberIn(given.minSize),
    maxSize: numberIn(given.maxSize),
    tolerance: numberIn(given.tolerance),
    featureAngle: numberIn(given.featureAngle),
    anglePerEdge: numberIn(given.anglePerEdge),
    layers: numberIn(given.layers),
    dropDetails: numberIn(given.dropDetails),
  };
  refuseOptions(checkRemeshOptions(options));
  return options;
}

/** Throws an InvalidInput if an option of a remeshing is given without one. */
export function refuseRemeshing(given: RemeshCommandOptions): void {
  const names = Object.keys(WRITTEN) as (keyof RemeshCommandOptions)[];
  const option = names.find((name) => given[name] !== undefined);
  if (option === undefined) return;
  const written = WRITTEN[option];
  const message = `${written} is for surfaces that are remeshed`;
  refuseOptions([invalidOption(written, message, `Add --surface remesh, or omit ${written}.`)]);
}

/** Result of a requested refinement of a surface. */
export interface RefinementCounts {
  /** Number of triangles before and after. */
  readonly given: number;
  readonly triangles: number;
  readonly splitEdges: number;
  /** Longest given edge / target length. */
  readonly lengthRatio: number;
}

/** Result of a requested remeshing of a surface. */
export interface RemeshReport extends Omit<
  SurfaceRemesh,
  "surface" | "origin" | "triangleDeviation" | "diagnostics"
> {
  /** Number of triangles before and after. */
  readonly given: number;
  readonly triangles: number;
}

const countTriangles = ({ triangles }: SurfaceFile) => triangles.length / 3;

export async function refined(
  mesher: Mesher,
  given: SurfaceFile,
  options: RefineOptions,
  control: RunControl,
): Promise<{ readonly surface: SurfaceFile; readonly refinement: RefinementCounts }> {
  const {
    surface: split,
    origin,
    splitEdges,
    lengthRatio,
  } = await mesher.refineSurface(given, options, control);
  const surface = repairedSurface(given, { surface: split, origin });
  const counts = { given: countTriangles(given), triangles: countTriangles(surface) };
  const refinement = { ...counts, splitEdges, lengthRatio };
  return { surface, refinement };
}

interface RemeshedSurface {
  readonly surface: SurfaceFile;
  readonly remesh: RemeshReport;
  readonly diagnostics: readonly Diagnostic[];
}

export async function remeshed(
  mesher: Mesher,
  given: SurfaceFile,
  options: RemeshOptions,
  control: PartialControl,
): Promise<RemeshedSurface> {
  const made = await mesher.remeshSurface(given, options, control);
  const { surface: _surface, origin: _origin, triangleDeviation: _deviation, diagnostics, ...figures } = made;
  const surface = repairedSurface(given, made);
  const remesh = { given: countTriangles(given), triangles: countTriangles(surface), ...figures };
  return { surface, remesh, diagnostics };
}

export function refinementText({ given, triangles, splitEdges }: RefinementCounts): string {
  return `refined: ${plural(given, "triangle")} before, ${triangles} after, ${plural(splitEdges, "edge")} split`;
}

/** Number of significant digits of lengths. */
const DIGITS = 3;
const POSITION_DIGITS = 5;
const LISTED_DETAILS = 5;

/** The option of a command that lists all dropped details. */
export type DetailList = "--report FILE" | "--json";

function mergedText(merged: RemeshReport["mergedDetails"], whole: DetailList): string {
  const at = (position: readonly number[]) =>
    `(${position.map((coordinate) => short(coordinate, POSITION_DIGITS)).join(", ")})`;
  const moves = merged.slice(0, LISTED_DETAILS).map(({ from, onto }) => `${at(from)} onto ${at(onto)}`);
  const left = merged.length - LISTED_DETAILS;
  const more = left > 0 ? `, and ${left} more (${whole} lists all ${merged.length})` : "";
  return `${plural(merged.length, "detail")} dropped: ${moves.join(", ")}${more}`;
}

/**
 * Describes a remeshing: triangles, chosen sizes, shapes, the distance from the given surface, and the first of the details
 * that were dropped. `whole`: the option that lists all of them.
 */
export function remeshText(remesh: RemeshReport, whole: DetailList): string {
  const { given, triangles, size, minSize, tolerance, deviation, patches, featureLines } = remesh;
  return [
    `remeshed: ${plural(given, "triangle")} before, ${triangles} after`,
    `target sizes ${short(minSize, DIGITS)} to ${short(size, DIGITS)}`,
    `${plural(patches, "smooth patch")}, ${plural(featureLines, "feature line")}`,
    `smallest angle ${remesh.smallestAngle.toFixed(1)}°, mean radius ratio ${remesh.meanRadiusRatio.toFixed(3)}`,
    `deviation at most ${short(deviation, DIGITS)} (tolerance ${short(tolerance, DIGITS)})`,
    ...(remesh.mergedDetails.length === 0 ? [] : [mergedText(remesh.mergedDetails, whole)]),
  ].join("; ");
}
