/** Options of a remeshing on the command line, and what is printed about its result. */
import type { MeshOptions, RemeshOptions, RemeshSettings } from "../api/option-types.js";
import { checkRemeshOptions } from "../api/options.js";
import { givenRemeshSetting } from "../api/surface-mesh-options.js";
import type { RefinementCounts, RemeshReport } from "../api/surface-treatment.js";
import { plural } from "../base/plural.js";
import { short } from "../base/short.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { numberIn, refuseOptions } from "./input.js";

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

/** Returns the options of a remeshing beside its sizes, unchecked. */
export function remeshSettingsIn(given: RemeshCommandOptions): RemeshSettings {
  return {
    minSize: numberIn(given.minSize),
    maxSize: numberIn(given.maxSize),
    tolerance: numberIn(given.tolerance),
    featureAngle: numberIn(given.featureAngle),
    anglePerEdge: numberIn(given.anglePerEdge),
    layers: numberIn(given.layers),
    dropDetails: numberIn(given.dropDetails),
  };
}

/** Returns the options of a remeshing with these sizes. Throws an InvalidInput if one is invalid. */
export function remeshOptions(
  given: RemeshCommandOptions,
  { size, growth, maxVolume, innerShells, background }: MeshOptions,
): RemeshOptions {
  const sizes = { size, growth, maxVolume, innerShells, background };
  const options: RemeshOptions = { ...sizes, ...remeshSettingsIn(given) };
  refuseOptions(checkRemeshOptions(options));
  return options;
}

/** Throws an InvalidInput if an option of a remeshing is given for a project. */
export function refuseRemeshing(given: RemeshSettings): void {
  const setting = givenRemeshSetting(given);
  if (setting === undefined) return;
  const message = `\`${setting}\` is for surfaces, but the input is a project`;
  refuseOptions([invalidOption(setting, message, "Omit it: each body has a remeshing of its own.")]);
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
