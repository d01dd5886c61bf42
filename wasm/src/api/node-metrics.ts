/** Metrics at the nodes of a background mesh, from its node values `metric`, or `size`, `stretching` and `direction`. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { map } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { invalidArrays } from "../diagnostics/package-diagnostic.js";
import type { NodeData, VolumeInput } from "../mesh/mesh.js";
import { notPositive } from "./node-sizes.js";

const SIX = 6;

/** Returns six numbers per node: xx xy xz yy yz zz. Rejects a mesh without sizes and arrays of a wrong length. */
export function metricsOf(mesh: VolumeInput): Float64Array {
  const given: unknown = mesh;
  checkArgument("background", given, v.object({ nodeData: v.optional(map) }));
  const nodeData: ReadonlyMap<string, NodeData> = mesh.nodeData ?? new Map<string, NodeData>();
  const { points } = mesh;
  const count = points.length / 3;
  const metric = nodeData.get("metric")?.values;
  if (metric !== undefined) {
    if (metric.length !== SIX * count) {
      refuse([
        invalidArrays(
          "`metric` must have six values per node",
          "Store xx, xy, xz, yy, yz and zz of the metric at each node.",
        ),
      ]);
    }
    return Float64Array.from(metric);
  }
  const sizes = nodeData.get("size")?.values ?? new Float64Array();
  if (!nodeData.has("size")) {
    refuse([
      invalidArrays(
        "the background has no metric and no sizes at its nodes",
        "Use a mesh with node values `metric`, or `size` with `stretching` and `direction`.",
      ),
    ]);
  }
  const stretchings = nodeData.get("stretching")?.values ?? new Float64Array(count).fill(1);
  const directions = nodeData.get("direction")?.values ?? new Float64Array(3 * count);
  if (sizes.length !== count || stretchings.length !== count || directions.length !== 3 * count) {
    refuse([
      invalidArrays(
        "`size` and `stretching` must have one value per node, `direction` three",
        "Store one size per node, and one stretching and a direction of three components, or neither.",
      ),
    ]);
  }
  return stretchedMetrics(sizes, stretchings, directions);
}

function stretchedMetrics(
  sizes: ArrayLike<number>,
  stretchings: ArrayLike<number>,
  directions: ArrayLike<number>,
): Float64Array {
  const metrics = new Float64Array(SIX * sizes.length);
  for (let node = 0; node < sizes.length; ++node) {
    const across = (sizes[node] ?? 0) ** -2;
    const [x = 0, y = 0, z = 0] = [0, 1, 2].map((k) => directions[3 * node + k]);
    const square = x * x + y * y + z * z;
    const less = square > 0 ? (across * ((stretchings[node] ?? 1) ** -2 - 1)) / square : 0;
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

/** Returns an error about the first node whose metric is not positive definite. */
export function wrongMetrics(metrics: Float64Array): Diagnostic[] {
  for (let node = 0; SIX * node < metrics.length; ++node) {
    const [xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0] = metrics.subarray(SIX * node, SIX * node + SIX);
    const second = xx * yy - xy * xy;
    const determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    // Comparisons with NaN are false.
    if (xx > 0 && second > 0 && determinant > 0 && Number.isFinite(determinant)) continue;
    return [notPositive(node)];
  }
  return [];
}
