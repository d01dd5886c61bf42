/** Sentences about what was done to a surface before it was filled. */
import { plural } from "../base/plural.js";
import { positionText } from "../base/position-text.js";
import { short } from "../base/short.js";
import type { NodePlacement, RepairChange } from "../mesh/inspection.js";
import type { RefinementCounts, RemeshReport } from "./meshed-surface.js";

/** Describes a split of patches by their numbers. */
export function splitText({ before, after }: { readonly before: number; readonly after: number }): string {
  return `split: ${plural(before, "patch")} before, ${after} after`;
}

/** Describes a repair by the numbers of its changes, and the largest distance by which a node was moved. */
export function repairText(changes: readonly RepairChange[], deviation: number): string {
  if (changes.length === 0) return "nothing to repair";
  const moved =
    deviation === 0 ? "no node was moved" : `nodes were moved by at most ${short(deviation, DIGITS)}`;
  return `${plural(changes.length, "change")}; ${moved}.`;
}

export function refinementText({ given, triangles, splitEdges }: RefinementCounts): string {
  return `refined: ${plural(given, "triangle")} before, ${triangles} after, ${plural(splitEdges, "edge")} split`;
}

/** Number of significant digits of lengths. */
const DIGITS = 3;
/** Details or faces that a text names. */
const LISTED = 5;

function mergedText(merged: RemeshReport["mergedDetails"], whole: string): string {
  const moves = merged
    .slice(0, LISTED)
    .map(({ from, onto }) => `${positionText(from)} onto ${positionText(onto)}`);
  const left = merged.length - LISTED;
  const more = left > 0 ? `, and ${left} more (${whole} lists all ${merged.length})` : "";
  return `${plural(merged.length, "detail")} dropped: ${moves.join(", ")}${more}`;
}

function placementText({ placed, unplaced, largestMove }: NodePlacement): string {
  const others = unplaced === 0 ? "" : `, ${unplaced} beside them`;
  return `${plural(placed, "node")} on the true faces${others} (moved by at most ${short(largestMove, DIGITS)})`;
}

function facesText({ onFaces, failedFaces }: RemeshReport): string {
  if (failedFaces.length === 0) return onFaces ? ", on the surfaces of the faces" : "";
  const names = failedFaces.slice(0, LISTED).map((face) => `face ${face + 1}`);
  const more = failedFaces.length - names.length;
  const last = more > 0 ? `${more} more` : names.pop();
  const named = names.length > 0 ? `${names.join(", ")} and ${last}` : last;
  const where = `cannot be triangulated on ${failedFaces.length > 1 ? "their surfaces" : "its surface"}`;
  return onFaces
    ? `, on the surfaces of the faces, except ${named}, which ${where}: there, the given triangles were changed`
    : `, by changing the given triangles, because ${named} ${where}`;
}

/**
 * Describes a remeshing: triangles, chosen sizes, shapes, the distance from the given surface, and the first of the details
 * that were dropped. `whole`: what lists all of them.
 */
export function remeshText(remesh: RemeshReport, whole: string): string {
  const { given, triangles, size, minSize, tolerance, deviation, patches, featureLines } = remesh;
  return [
    `remeshed: ${plural(given, "triangle")} before, ${triangles} after${facesText(remesh)}`,
    `target sizes ${short(minSize, DIGITS)} to ${short(size, DIGITS)}`,
    `${plural(patches, "smooth patch")}, ${plural(featureLines, "feature line")}`,
    `smallest angle ${remesh.smallestAngle.toFixed(1)}°, mean radius ratio ${remesh.meanRadiusRatio.toFixed(3)}`,
    `deviation at most ${short(deviation, DIGITS)} (tolerance ${short(tolerance, DIGITS)})`,
    ...(remesh.placement === undefined ? [] : [placementText(remesh.placement)]),
    ...(remesh.mergedDetails.length === 0 ? [] : [mergedText(remesh.mergedDetails, whole)]),
  ].join("; ");
}
