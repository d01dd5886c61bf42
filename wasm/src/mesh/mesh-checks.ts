/** Checks the structure of a mesh before a writer uses it. */
import * as v from "valibot";
import { plural, pluralOf } from "../base/plural.js";
import { firstOf, type Steps } from "../base/steps.js";
import { isA, isArrayOf, isDetached, shown } from "../base/values.js";
import { doubles, integers, problemIn } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { CurvedEdges, Mesh } from "./mesh.js";
import { NO_REGION } from "../generated/constants.js";

export const groupSchema = v.object({
  name: v.string(),
  tag: v.number(),
  color: v.optional(v.array(v.number())),
});

/** Regions on the sides of triangles. */
export const regionsOnSides = v.pipe(
  v.object({
    regions: v.array(groupSchema),
    triangleRegions: integers(2),
    areMeshed: v.optional(v.boolean()),
    maxVolumes: v.optional(doubles()),
  }),
  v.rawCheck(({ dataset, addIssue }) => {
    if (!dataset.typed) return;
    const { regions, triangleRegions } = dataset.value;
    const at = triangleRegions.findIndex((region) => region >= regions.length && region !== NO_REGION);
    if (at < 0) return;
    const message = `triangleRegions[${at}] is ${triangleRegions[at]}, but the number of regions is ${regions.length}`;
    addIssue({ message });
  }),
);

/**
 * Checks types, lengths and indices, because callers without type checks may pass anything. Returns no diagnostic
 * if they are valid.
 */
export function* checkFileMesh(mesh: Mesh): Steps<Diagnostic[]> {
  const given: unknown = mesh;
  const what = yield* faultIn(typeof given === "object" && given !== null ? given : {});
  if (what === undefined) return [];
  const remedy = "Pass a mesh from a reader or a run.";
  return [packageDiagnostic("invalid-arrays", `the mesh is invalid: ${what}`, remedy)];
}

function* faultIn({
  points,
  nodeData,
  elementData = new Map(),
  ...rest
}: Partial<Mesh>): Steps<string | undefined> {
  if (!isArrayOf(Float64Array, points) || points.length % 3 !== 0 || isDetached(points)) {
    return "points is not a Float64Array with x y z per node";
  }
  const count = points.length / 3;
  const wild = yield* firstOf(points, (value) => !Number.isFinite(value));
  if (wild >= 0) return `node ${Math.floor(wild / 3)} has a coordinate that is not finite`;
  return (
    faultOfData("nodeData", nodeData, count, "node") ??
    (yield* faultOfCurved(count, rest.curvedEdges)) ??
    (yield* faultOf("triangle", 3, count, rest.triangles, rest.trianglePatch, rest.patches)) ??
    (yield* faultOf("tetrahedron", 4, count, rest.tetrahedra, rest.tetrahedronRegion, rest.regions)) ??
    faultOfData("elementData", elementData, (rest.tetrahedra?.length ?? 0) / 4, "tetrahedron")
  );
}

function faultOfData(name: string, data: unknown, count: number, word: string): string | undefined {
  if (!isA("Map", data)) return `${name} is not a Map`;
  const wrong = [...(data as ReadonlyMap<unknown, unknown>)].find(
    ([key, given]) => !isData(key, given, count),
  );
  return (
    wrong &&
    `${name} ${shown(wrong[0])} does not have \`components\` values for each of ${plural(count, word)}`
  );
}

/** Returns whether the entry has a name and the stated number of values per node or tetrahedron. */
function isData(name: unknown, given: unknown, count: number): boolean {
  if (typeof name !== "string" || !v.is(nodeValues, given)) return false;
  const { components, values } = given;
  return Number.isInteger(components) && components > 0 && values.length === components * count;
}

const nodeValues = v.object({ components: v.number(), values: doubles() });

const curvedEdges = v.optional(v.object({ edges: integers(2), middles: doubles(3) }));

function* faultOfCurved(count: number, given: unknown): Steps<string | undefined> {
  const problem = problemIn(curvedEdges, given);
  if (problem !== undefined) {
    return `curvedEdges${problem.path === "" ? "" : `.${problem.path}`} is invalid: ${problem.message}`;
  }
  const { edges, middles } = (given as CurvedEdges | undefined) ?? NO_EDGES;
  if (3 * edges.length !== 2 * middles.length) return "curvedEdges must have one middle per edge";
  const wild = yield* firstOf(edges, (node) => node >= count);
  if (wild >= 0) return `curvedEdges refers to node ${edges[wild]}, but the number of nodes is ${count}`;
  const infinite = yield* firstOf(middles, (value) => !Number.isFinite(value));
  return infinite < 0 ? undefined : "curvedEdges has a middle that is not finite";
}

const NO_EDGES: CurvedEdges = { edges: new Uint32Array(), middles: new Float64Array() };

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
    return `the nodes or group indices of the ${pluralOf(word)} are not a Uint32Array, or their groups are not an array`;
  }
  if (nodes.length !== width * owners.length) return `there must be one group index per ${word}`;
  const wild = yield* firstOf(nodes, (node) => node >= count);
  if (wild >= 0)
    return `${word} ${Math.floor(wild / width)} refers to node ${nodes[wild]}, but the number of nodes is ${count}`;
  const named = groups.findIndex((given) => !v.is(groupSchema, given));
  if (named >= 0) return `group ${named} of the ${pluralOf(word)} has no valid name, tag or color`;
  const lost = yield* firstOf(owners, (owner) => owner >= groups.length);
  return lost < 0
    ? undefined
    : `${word} ${lost} refers to group ${owners[lost]}, but the number of groups is ${groups.length}`;
}
