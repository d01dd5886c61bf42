/** Whether the arrays of a mesh fit together, before a writer walks through them. */
import {
  aNumber,
  arrayOf,
  aString,
  isA,
  isArrayOf,
  isDetached,
  listOf,
  objectOf,
  orNothing,
  shown,
  type Check,
} from "../base/argument-checks.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../api/types.js";
import { NO_REGION } from "../base/interfaces.js";
import type { FileMesh, NodeData } from "./file-mesh.js";
import type { SurfaceRegions } from "./region-names.js";
import { firstOf, type Steps } from "./steps.js";

const checkGroup = objectOf({ name: aString, tag: aNumber, color: orNothing(listOf(aNumber)) });

const areRegions = objectOf({ regions: listOf(checkGroup), triangleRegions: arrayOf(Uint32Array, 2) });

/** A surface of a file beside its points and triangles: what its patches and regions are. */
export const hasPatches: Check = objectOf({
  trianglePatch: arrayOf(Uint32Array),
  patches: listOf(checkGroup),
  surfaceRegions: orNothing((given) => areRegions(given) ?? wildRegion(given as SurfaceRegions)),
});

function wildRegion({ regions, triangleRegions }: SurfaceRegions): string | undefined {
  const wild = triangleRegions.findIndex((region) => region >= regions.length && region !== NO_REGION);
  return wild < 0 ? undefined : `.triangleRegions[${wild}] is ${triangleRegions[wild]} of ${regions.length}`;
}

/** The form alone; callers without type checks may give anything. Empty where all is well. */
export function* checkFileMesh(mesh: FileMesh): Steps<Diagnostic[]> {
  const given: unknown = mesh;
  const what = yield* faultIn(typeof given === "object" && given !== null ? given : {});
  if (what === undefined) return [];
  const remedy = "Give a mesh as readMesh and fileMeshOf make it.";
  return [packageDiagnostic("invalid-arrays", `the mesh cannot be written: ${what}`, remedy)];
}

function* faultIn({ points, nodeData, ...rest }: Partial<FileMesh>): Steps<string | undefined> {
  if (!isArrayOf(Float64Array, points) || points.length % 3 !== 0 || isDetached(points)) {
    return "its points are no Float64Array of x y z each";
  }
  if (!isA("Map", nodeData)) return "it has no map of numbers at the nodes";
  const count = points.length / 3;
  const wild = yield* firstOf(points, (value) => !Number.isFinite(value));
  if (wild >= 0) return `node ${Math.floor(wild / 3)} has no finite place`;
  const data = [...(nodeData as ReadonlyMap<unknown, unknown>)].find(
    ([name, given]) => !isData(name, given, count),
  );
  if (data !== undefined)
    return `its numbers ${shown(data[0])} are not so many for each of ${plural(count, "node")}`;
  return (
    (yield* faultOf("triangle", 3, count, rest.triangles, rest.trianglePatch, rest.patches)) ??
    (yield* faultOf("tetrahedron", 4, count, rest.tetrahedra, rest.tetrahedronRegion, rest.regions))
  );
}

/** A name, and as many numbers for every node as are said. */
function isData(name: unknown, given: unknown, count: number): boolean {
  if (typeof name !== "string" || aNodeData(given) !== undefined) return false;
  const { components, values } = given as NodeData;
  return Number.isInteger(components) && components > 0 && values.length === components * count;
}

const aNodeData = objectOf({ components: aNumber, values: arrayOf(Float64Array) });

function* faultOf(
  word: string,
  width: number,
  count: number,
  nodes: unknown,
  owners: unknown,
  groups: unknown,
): Steps<string | undefined> {
  if (
    !(isArrayOf(Uint32Array, nodes) && isArrayOf(Uint32Array, owners) && Array.isArray(groups)) ||
    isDetached(nodes)
  ) {
    return `a ${word}'s nodes or groups are no Uint32Array, or the groups have no list`;
  }
  if (nodes.length !== width * owners.length) return `there is not one group per ${word}`;
  const wild = yield* firstOf(nodes, (node) => node >= count);
  if (wild >= 0) return `${word} ${Math.floor(wild / width)} refers to node ${nodes[wild]} of ${count}`;
  const named = groups.findIndex((group) => checkGroup(group) !== undefined);
  if (named >= 0) return `group ${named} of its ${word}s has no name or no number`;
  const lost = yield* firstOf(owners, (owner) => owner >= groups.length);
  return lost < 0 ? undefined : `${word} ${lost} is of group ${owners[lost]} of ${groups.length}`;
}
