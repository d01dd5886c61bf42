/** Sizes of a background grid among the values at the nodes of a mesh. */
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

/**
 * Returns the node values `size` of a mesh and, if it has both, `stretching` and `direction`. A name may differ in case if no
 * other name then matches. Rejects values with a wrong number per node.
 */
export function sizesAtNodes({ points, tetrahedra, nodeData = new Map() }: VolumeInput): NodeSizes {
  const count = points.length / 3;
  const of = (name: string) => {
    const values = nodeData.get(keyOf({ nodeData }, name) ?? name)?.values;
    checkArgument(`mesh.nodeData "${name}"`, values, v.optional(doubles()));
    return values;
  };
  const [sizes, stretchings, directions] = [of("size"), of("stretching"), of("direction")];
  const refuseIf = (isWrong: boolean, message: string) => {
    const remedy =
      "Store one size per node, and one stretching and a direction of three components, or neither.";
    if (isWrong) refuse([invalidArrays(message, remedy)]);
  };
  refuseIf(sizes !== undefined && sizes.length !== count, "`size` must have one value per node");
  if (stretchings === undefined) return { ...(sizes && { sizes }) };
  refuseIf(stretchings.length !== count, "`stretching` must have one value per node");
  refuseIf(directions?.length !== 3 * count, "`stretching` needs `direction` with three values per node");
  const isUsed = new Uint8Array(count);
  for (const node of tetrahedra) isUsed[node] = 1;
  return {
    ...(sizes && { sizes }),
    stretchings: stretchings.filter((_, node) => isUsed[node] === 1),
    directions: directions?.filter((_, i) => isUsed[Math.floor(i / 3)] === 1),
  };
}

/** Returns the node values `metric` of a mesh that has no `size`; undefined if there are none. Rejects a wrong number per node. */
export function metricsAtNodes({ points, nodeData = new Map() }: VolumeInput): Float64Array | undefined {
  const metric = keyOf({ nodeData }, "metric");
  if (metric === undefined || keyOf({ nodeData }, "size") !== undefined) return undefined;
  const values = nodeData.get(metric)?.values;
  checkArgument('mesh.nodeData "metric"', values, v.optional(doubles()));
  if (values?.length !== 2 * points.length) {
    const remedy = "Store xx, xy, xz, yy, yz and zz of the metric at each node.";
    refuse([invalidArrays("`metric` must have six values per node", remedy)]);
  }
  return values;
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
