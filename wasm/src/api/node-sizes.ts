/** Sizes and metrics of a background grid among the values at the nodes of a mesh. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { doubles, map } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { invalidArrays } from "../diagnostics/package-diagnostic.js";
import type { Mesh, VolumeInput } from "../mesh/mesh.js";
import type { BackgroundArrays } from "../project/background-arrays.js";

type WithData = Pick<Mesh, "nodeData">;

/** Sizes at the nodes of a mesh, as a file stores them; stretchings and directions of those nodes that have a tetrahedron. */
export type NodeSizes = Partial<Pick<BackgroundArrays, "sizes" | "stretchings" | "directions">>;

/** Values of a mesh at all its nodes, by the names that a background grid uses. */
interface SizeValues {
  readonly sizes?: Float64Array | undefined;
  /** Both or neither. */
  readonly stretched?: { readonly stretchings: Float64Array; readonly directions: Float64Array } | undefined;
}

/** Returns the node values `size`, and `stretching` with `direction`. Rejects values with a wrong number per node. */
function sizeValues(mesh: VolumeInput): SizeValues {
  const count = mesh.points.length / 3;
  const [sizes, stretchings, directions] = ["size", "stretching", "direction"].map((name) =>
    valuesOf(mesh, name),
  );
  const refuseIf = (isWrong: boolean, message: string) => {
    const remedy =
      "Store one size per node, and one stretching and a direction of three components, or neither.";
    if (isWrong) refuse([invalidArrays(message, remedy)]);
  };
  refuseIf(sizes !== undefined && sizes.length !== count, "`size` must have one value per node");
  if (stretchings === undefined) return { sizes };
  refuseIf(stretchings.length !== count, "`stretching` must have one value per node");
  if (directions?.length === 3 * count) return { sizes, stretched: { stretchings, directions } };
  refuseIf(true, "`stretching` needs `direction` with three values per node");
  return { sizes };
}

/** Returns the node values of this name, whose case may differ if no other name then matches. */
function valuesOf({ nodeData = new Map() }: VolumeInput, name: string): Float64Array | undefined {
  const values = nodeData.get(keyOf({ nodeData }, name) ?? name)?.values;
  checkArgument(`mesh.nodeData "${name}"`, values, v.optional(doubles()));
  return values;
}

/**
 * Returns the node values `size` of a mesh and, if it has both, `stretching` and `direction`. A name may differ in case if no
 * other name then matches. Rejects values with a wrong number per node.
 */
export function sizesAtNodes(mesh: VolumeInput): NodeSizes {
  const { sizes, stretched } = sizeValues(mesh);
  if (stretched === undefined) return { ...(sizes && { sizes }) };
  const isUsed = new Uint8Array(mesh.points.length / 3);
  for (const node of mesh.tetrahedra) isUsed[node] = 1;
  return {
    ...(sizes && { sizes }),
    stretchings: stretched.stretchings.filter((_, node) => isUsed[node] === 1),
    directions: stretched.directions.filter((_, i) => isUsed[Math.floor(i / 3)] === 1),
  };
}

/** Returns the node values `metric` of a mesh that has no `size`; undefined if there are none. Rejects a wrong number per node. */
export function metricsAtNodes(mesh: VolumeInput): Float64Array | undefined {
  return valuesOf(mesh, "size") === undefined ? metricValues(mesh) : undefined;
}

/**
 * Returns the metric at each node, xx xy xz yy yz zz: the node values `metric`, else that of `size`, `stretching` and
 * `direction`. Rejects a mesh without either, and values with a wrong number per node.
 */
export function backgroundMetrics(mesh: VolumeInput): Float64Array {
  checkArgument("background", mesh, v.object({ nodeData: v.optional(map) }));
  const metrics = metricValues(mesh);
  if (metrics !== undefined) return metrics.slice();
  const { sizes, stretched } = sizeValues(mesh);
  if (sizes === undefined) {
    const remedy = "Use a mesh with node values `metric`, or `size` with `stretching` and `direction`.";
    refuse([invalidArrays("the background has no metric and no sizes at its nodes", remedy)]);
  }
  return stretchedMetrics(sizes ?? new Float64Array(), stretched);
}

function metricValues(mesh: VolumeInput): Float64Array | undefined {
  const values = valuesOf(mesh, "metric");
  if (values !== undefined && values.length !== 2 * mesh.points.length) {
    const remedy = "Store xx, xy, xz, yy, yz and zz of the metric at each node.";
    refuse([invalidArrays("`metric` must have six values per node", remedy)]);
  }
  return values;
}

function stretchedMetrics(sizes: Float64Array, stretched: SizeValues["stretched"]): Float64Array {
  const metrics = new Float64Array(SIX * sizes.length);
  for (let node = 0; node < sizes.length; node++) {
    const across = (sizes[node] ?? 0) ** -2;
    const [x = 0, y = 0, z = 0] = stretched?.directions.subarray(3 * node, 3 * node + 3) ?? [];
    const square = x * x + y * y + z * z;
    const less = square > 0 ? (across * ((stretched?.stretchings[node] ?? 1) ** -2 - 1)) / square : 0;
    const entries = [
      across + less * x * x,
      less * x * y,
      less * x * z,
      across + less * y * y,
      less * y * z,
      across + less * z * z,
    ];
    metrics.set(entries, SIX * node);
  }
  return metrics;
}

/** Numbers of a metric. */
const SIX = 6;

/** Returns an error about the first node whose metric is not positive definite. */
export function wrongMetrics(metrics: Float64Array): Diagnostic[] {
  for (let node = 0; SIX * node < metrics.length; node++) {
    const [xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0] = metrics.subarray(SIX * node, SIX * node + SIX);
    const second = xx * yy - xy * xy;
    const determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    // Comparisons with NaN are false.
    if (xx > 0 && second > 0 && determinant > 0 && Number.isFinite(determinant)) continue;
    return [notPositive(node)];
  }
  return [];
}

/** Says that the metric at a node is not one. */
export function notPositive(node: number): Diagnostic {
  const message = `the metric at node ${node} (counted from 0) is not positive definite, or its sizes differ by more than a factor of 1e6`;
  return invalidArrays(
    message,
    "Use a metric with three positive eigenvalues, the inverse squares of the sizes.",
  );
}

/**
 * Returns the name of the node values that equals `name`, or differs from it in case only and is the only such
 * name.
 */
function keyOf({ nodeData }: WithData, name: string): string | undefined {
  if (nodeData.has(name)) return name;
  const alike = [...nodeData.keys()].filter((key) => key.toLowerCase() === name);
  return alike.length === 1 ? alike[0] : undefined;
}

/**
 * Returns the names of the node values that a background grid does not use, in file order. Throws a `MesherError`
 * if `mesh` is invalid.
 */
export function unusedData(mesh: WithData): string[] {
  checkArgument("mesh", mesh, v.object({ nodeData: map }));
  const stretching = keyOf(mesh, "stretching");
  const used = [keyOf(mesh, "size"), stretching, stretching && keyOf(mesh, "direction")];
  // A background grid of `sizeFromSolution` has the same sizes once more as a full metric.
  used.push(keyOf(mesh, "metric"));
  return [...mesh.nodeData.keys()].filter((name) => !used.includes(name));
}
