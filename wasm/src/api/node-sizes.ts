/** Sizes of a background grid among the values at the nodes of a mesh. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { doubles, map } from "../calls/schemas.js";
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
  return [...mesh.nodeData.keys()].filter((name) => !used.includes(name));
}
