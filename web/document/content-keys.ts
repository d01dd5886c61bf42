import type {
  BodyPlacement,
  BodyRemeshing,
  BodyRepair,
  Project,
  ProjectBody,
  ProjectBodyPatch,
  ProjectExpression,
  ProjectGroup,
  ProjectLine,
  ProjectMeshing,
  ProjectParameter,
  ProjectPatch,
  ProjectPoint,
  ProjectSource,
} from "tetrafront/project";
import type { DocumentContent } from "./edit";
import { bodiesOf } from "./entities";
import { addReal, Hash, hashText, listHasher } from "./hash";
import { textKey } from "./long-texts";
import { numbersPerNode, packedNodes, packedSeconds, packedTetrahedra, partsOf } from "./packed-grid";
import { forEachInSlices } from "./slices";

/**
 * Keys that are equal for projects of equal content, even if the objects differ. `documentKey` shows whether a file
 * contains the project, `meshKey` whether a mesh was made from it. Each list is hashed once and remembered, so that
 * moving a point costs nothing for a large background grid, and little for a long list of points.
 */

/** Long lists are hashed number by number, without a text in between. */
function hashNodes(nodes: Project["background"]["nodes"]): string {
  const hash = new Hash();
  const packed = packedNodes(nodes);
  for (let first = 0; first < packed.length; first += numbersPerNode) addNode(hash, packed, first);
  for (const number of packedSeconds(nodes) ?? []) addReal(hash, number);
  return hash.text;
}

function addNode(hash: Hash, packed: Float64Array, first: number): void {
  hash.add(packed[first] ?? 0);
  const { stretching, direction } = partsOf(packed, first);
  hash.add((stretching ? 1 : 0) + (direction ? 2 : 0));
  for (let k = 1; k < 5; ++k) addReal(hash, packed[first + k] ?? 0);
  if (stretching) addReal(hash, packed[first + 5] ?? 0);
  if (direction) for (let k = 6; k < 9; ++k) addReal(hash, packed[first + k] ?? 0);
}

function hashTetrahedra(tetrahedra: Project["background"]["tetrahedra"]): string {
  const hash = new Hash();
  const packed = packedTetrahedra(tetrahedra);
  for (let i = 0; i < packed.length; ++i) hash.add(packed[i] ?? 0);
  return hash.text;
}

/** Hashes the lists of a large grid in slices, so that later keys of projects with this grid take no time. */
export async function prepareKeys({
  nodes,
  tetrahedra,
}: Pick<Project["background"], "nodes" | "tetrahedra">) {
  const ofNodes = new Hash();
  const packed = packedNodes(nodes);
  await forEachInSlices(nodes.length, (i) => addNode(ofNodes, packed, numbersPerNode * i));
  const seconds = packedSeconds(nodes) ?? new Float64Array();
  await forEachInSlices(seconds.length, (i) => addReal(ofNodes, seconds[i] ?? 0));
  gridHashes.set(nodes, ofNodes.text);
  const ofTetrahedra = new Hash();
  const ids = packedTetrahedra(tetrahedra);
  await forEachInSlices(ids.length, (i) => ofTetrahedra.add(ids[i] ?? 0));
  gridHashes.set(tetrahedra, ofTetrahedra.text);
}

/** All fields of a record, each once; a field added to the schema is an error here until it is listed. */
const fieldsOf = <Record>(fields: { readonly [Field in keyof Required<Record>]: true }): string[] =>
  Object.keys(fields);

const pointFields = fieldsOf<ProjectPoint>({ id: true, name: true, position: true });
const lineFields = fieldsOf<ProjectLine>({
  id: true,
  name: true,
  type: true,
  points: true,
  startTangent: true,
  endTangent: true,
});
const patchFields = fieldsOf<ProjectPatch>({ id: true, name: true, type: true, loops: true });
const sourceFields = fieldsOf<ProjectSource>({
  id: true,
  name: true,
  type: true,
  positions: true,
  size: true,
  distance: true,
  growth: true,
  body: true,
});
const meshingFields = fieldsOf<ProjectMeshing>({
  size: true,
  elements: true,
  gradation: true,
  innerShells: true,
  order: true,
  optimization: true,
  interior: true,
});

const bodyPatchFields = fieldsOf<ProjectBodyPatch>({
  id: true,
  name: true,
  color: true,
  solid: true,
  origin: true,
});
const remeshingFields = fieldsOf<BodyRemeshing>({
  size: true,
  minSize: true,
  maxSize: true,
  tolerance: true,
  featureAngle: true,
  anglePerEdge: true,
  layers: true,
  dropDetails: true,
  growth: true,
});
const repairFields = fieldsOf<BodyRepair>({ kind: true, count: true, positions: true });
const placementFields = fieldsOf<BodyPlacement>({ position: true, rotation: true, scale: true });

const groupFields = fieldsOf<ProjectGroup & ProjectGroup["members"][number]>({
  id: true,
  name: true,
  color: true,
  members: true,
  kind: true,
});
const parameterFields = fieldsOf<ProjectParameter>({ name: true, expression: true });
const expressionFields = fieldsOf<Extract<ProjectExpression, { readonly id: number }>>({
  kind: true,
  id: true,
  field: true,
  expression: true,
});

const withoutName = (fields: readonly string[]): string[] => fields.filter((field) => field !== "name");

/** Hashes records field by field in the given order, whatever the order of the fields in a record. */
const hashRecords = (records: readonly object[], fields: string[]): string =>
  hashText(JSON.stringify(records, fields));

/** As `hashRecords`, for lists of which edits change a few records. */
const hasherOf = <Item extends object>(fields: string[]) =>
  listHasher<Item>((item) => JSON.stringify(item, fields));

/** Returns what `compute` makes of an object; computes it once per object. */
function remembering<In extends object, Out>(compute: (input: In) => Out): (input: In) => Out {
  const known = new WeakMap<In, Out>();
  return (input) => {
    let output = known.get(input);
    if (output === undefined) {
      output = compute(input);
      known.set(input, output);
    }
    return output;
  };
}

/** Hashes of the lists of background grids. */
const gridHashes = new WeakMap<object, string>();

function gridHash<List extends object>(list: List, compute: (list: List) => string): string {
  const hash = gridHashes.get(list) ?? compute(list);
  gridHashes.set(list, hash);
  return hash;
}

const hashesOf = {
  points: hasherOf<ProjectPoint>(pointFields),
  lines: hasherOf<ProjectLine>(lineFields),
  patches: hasherOf<ProjectPatch>(patchFields),
  sources: hasherOf<ProjectSource>(sourceFields),
  groups: hasherOf<ProjectGroup>(groupFields),
  parameters: hasherOf<ProjectParameter>(parameterFields),
  expressions: hasherOf<ProjectExpression>(expressionFields),
};

const namelessHashesOf = {
  points: hasherOf<ProjectPoint>(withoutName(pointFields)),
  lines: hasherOf<ProjectLine>(withoutName(lineFields)),
  patches: hasherOf<ProjectPatch>(withoutName(patchFields)),
  sources: hasherOf<ProjectSource>(withoutName(sourceFields)),
};

/** Returns the key of the given triangles of a body and their patches. */
export function givenSurfaceKey({ points, triangles, trianglePatch = "", trueFaces }: ProjectBody): string {
  const texts = [points, triangles, trianglePatch, ...(trueFaces === undefined ? [] : [trueFaces])];
  return texts.map(textKey).join(" ");
}

/** Returns the key of everything that the treated triangles of a body depend on, apart from sizes of the project. */
export const namelessBodyKey = remembering((body: ProjectBody): string => {
  const { id, patches, surface = "remesh", remeshing = {}, placement = {} } = body;
  const head = [
    id,
    surface,
    JSON.stringify(remeshing, remeshingFields),
    JSON.stringify(placement, placementFields),
  ];
  return [...head, hashRecords(patches, withoutName(bodyPatchFields)), givenSurfaceKey(body)].join(" ");
});

/** Returns the key of where the given triangles of a body are. */
export const placedSurfaceKey = remembering(
  (body: ProjectBody): string =>
    `${JSON.stringify(body.placement ?? {}, placementFields)} ${givenSurfaceKey(body)}`,
);

/** Returns a key of the surfaces of bodies and of where they are. Names, sizes and the order of the bodies do not change it. */
export const placedSurfacesKey = remembering((bodies: readonly ProjectBody[]): string =>
  bodies.map(placedSurfaceKey).toSorted().join(" | "),
);

/** Makes the JSON of records the same whatever the order of their fields. */
const inOrder = (_key: string, value: unknown): unknown =>
  typeof value === "object" && value !== null && !Array.isArray(value)
    ? Object.fromEntries(Object.entries(value).sort(([a], [b]) => (a < b ? -1 : 1)))
    : value;

const bodyKey = remembering((body: ProjectBody): string =>
  [
    namelessBodyKey(body),
    hashText(body.name ?? ""),
    hashRecords(body.patches, bodyPatchFields),
    hashRecords(body.repairs ?? [], repairFields),
    body.repairDeviation,
    hashText(JSON.stringify([body.features, body.failures, body.isOutdated], inOrder)),
  ].join(" "),
);

const usedPoints = remembering(
  (lines: readonly ProjectLine[]) => new Set(lines.flatMap(({ points }) => points)),
);

/** The hash of the points that lines use, per list of points for the lines it was computed with. */
const usedPointHashes = new WeakMap<object, { readonly lines: object; readonly hash: string }>();

function usedPointHash({ points, lines }: Project): string {
  const known = usedPointHashes.get(points);
  if (known?.lines === lines) return known.hash;
  const used = usedPoints(lines);
  const hash = namelessHashesOf.points(points.filter(({ id }) => used.has(id)));
  usedPointHashes.set(points, { lines, hash });
  return hash;
}

const noSources: readonly ProjectSource[] = [];
const noNotes: readonly never[] = [];

/** Returns the part that both keys share; it does not depend on names and points. */
function sizeParts({ background, meshing = {} }: Project): readonly (string | number)[] {
  const { nodes, tetrahedra, coverageMargin = 0 } = background;
  return [
    JSON.stringify(meshing, meshingFields),
    coverageMargin,
    gridHash(nodes, hashNodes),
    gridHash(tetrahedra, hashTetrahedra),
  ];
}

/** Returns the key of everything that a project file holds. */
export const documentKey = remembering((project: Project): string => {
  const { points, lines, patches, bodies: _bodies, background, meshing: _meshing, ...rest } = project;
  const { groups = noNotes, parameters = noNotes, expressions = noNotes, problem, ...head } = rest;
  const { points: ofPoints, lines: ofLines, patches: ofPatches, sources: ofSources } = hashesOf;
  return [
    JSON.stringify(head, Object.keys(head).sort()),
    ...sizeParts(project),
    ofPoints(points),
    ofLines(lines),
    ofPatches(patches),
    ofSources(background.sources ?? noSources),
    hashesOf.groups(groups),
    hashesOf.parameters(parameters),
    hashesOf.expressions(expressions),
    ...(problem ? [hashText(JSON.stringify(problem, inOrder))] : []),
    ...bodiesOf(project).map(bodyKey),
  ].join(" ");
});

/** Returns the key of everything that a mesh depends on: no names, and no points that no line uses. */
export const meshKey = remembering((project: Project): string => {
  const { lines, patches, background } = project;
  return [
    ...sizeParts(project),
    usedPointHash(project),
    namelessHashesOf.lines(lines),
    namelessHashesOf.patches(patches),
    namelessHashesOf.sources(background.sources ?? noSources),
    ...bodiesOf(project).map(namelessBodyKey),
  ].join(" ");
});

/** Returns the key of the mesh that belongs to a state of a document. */
export function shownMeshKey({ project, meshVersion }: DocumentContent): string {
  const key = meshKey(project);
  return meshVersion?.startsWith(versionedKey(key, "")) === true ? meshVersion : key;
}

/** Returns the key of another mesh of the project with this key. */
export const versionedKey = (key: string, version: string): string => `${key}#${version}`;

/** Returns the key of the names that messages about bodies use. */
export const namesKey = ({ patches, bodies = [] }: Project): string =>
  hashText(
    JSON.stringify([
      ...patches.map(({ name }) => name),
      ...bodies.map(({ name, patches: own }) => [name, own.map((patch) => patch.name)]),
    ]),
  );

/** Returns the key of everything that the treated triangles of a body depend on. */
export function preparedKey(project: Project, body: ProjectBody): string {
  const { size, gradation, innerShells, elements } = project.meshing ?? {};
  const { sources = noSources } = project.background;
  const sizes = sizeParts({ ...project, meshing: { size, gradation, innerShells } });
  const counted = elements === undefined ? [] : [`elements ${elements}`];
  return [...sizes, ...counted, namelessHashesOf.sources(sources), namelessBodyKey(body)].join(" ");
}
