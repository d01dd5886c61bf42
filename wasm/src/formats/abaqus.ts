/**
 * Writes Abaqus and CalculiX `.inp` files: C3D4 or C3D10 tetrahedra in one element set and solid section per region, whose
 * name is the material's name; per patch, a node set and a surface of element faces. Boundary conditions and loads
 * refer to these names. An interface between regions gets one surface per side. Material properties are left to the
 * user.
 */
import { stepwise } from "../base/steps.js";
import type { Mesh } from "../mesh/mesh.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { type Group, type Naming, patchGroups, regionGroups, usedGroups } from "./groups.js";
import type { WrittenMesh } from "./second-order.js";
import { coordinates, fromOne, numberRows } from "./number-rows.js";
import { NONE, tetFaces } from "./tet-faces.js";

/** Abaqus face names by the opposite corner: S1 has the corners 1 2 3, S2 1 2 4, S3 2 3 4, S4 1 3 4. */
const FACE_OPPOSITE = ["S3", "S4", "S2", "S1"];
/** Largest number of entries on a data line. */
const PER_LINE = 16;
/** Abaqus allows 80 characters, of which a leading `N_` and a trailing `_FACES` may need 8. */
const NAMING: Naming = { toPlain: plainName, maxBytes: 72, isCaseInsensitive: true };

/** Returns the bytes of an Abaqus input file. Triangles without a tetrahedron appear in the node sets only. */
export function* writeAbaqus(mesh: WrittenMesh, note: Note): Generator<Part, void> {
  const regions = yield* regionGroups(mesh, { ...NAMING, note });
  const patches = yield* patchGroups(mesh, { ...NAMING, note });
  yield [
    "*HEADING\nTetrafront\n*NODE\n",
    numberRows(mesh.points, 3, (row, i) => `${i + 1}, ${coordinates(row, ", ")}`),
    ...elementSets(regions),
    ...nodeSets(patches),
    surfaces(mesh, patches),
    ...regions.map(({ name }) => `*SOLID SECTION, ELSET=${name}, MATERIAL=${name}\n`),
    ...regions.map(({ name }) => `*MATERIAL, NAME=${name}\n`),
  ];
}

/** Returns a letter followed by letters, digits and underscores, which every reader of the format accepts. */
function plainName(name: string): string {
  const plain = name.replace(/[^A-Za-z0-9_]+/g, "_");
  return /^[A-Za-z]/.test(plain) ? plain : `N_${plain}`;
}

/** Numbers the elements from 1, region by region, as `elementNumbers` does. */
function elementSets(regions: readonly Group[]): Part[] {
  let number = 1;
  return regions.flatMap(({ kind, name, nodes }) => [
    `*ELEMENT, TYPE=C3D${kind.nodes}, ELSET=${name}\n`,
    numberRows(nodes, kind.nodes, (row) => `${number++}, ${fromOne(row, ", ")}`),
  ]);
}

function nodeSets(patches: readonly Group[]): string[] {
  return patches.flatMap(({ name, nodes }) => {
    const numbers = [...new Set(nodes)].sort((a, b) => a - b).map((node) => node + 1);
    const lines: string[] = [];
    for (let i = 0; i < numbers.length; i += PER_LINE) lines.push(numbers.slice(i, i + PER_LINE).join(", "));
    return [`*NSET, NSET=${name}\n${lines.join("\n")}\n`];
  });
}

function* surfaces(mesh: Mesh, patches: readonly Group[]): Generator<Part, void> {
  const { faceOfTriangle, twin } = yield* tetFaces(mesh);
  const numbers = elementNumbers(mesh);
  /** Per patch: the element faces oriented as its triangles, and those of the elements across an interface. */
  const faces = mesh.patches.map(() => ({ FACES: [] as string[], BACK: [] as string[] }));
  const line = (face: number) => `${numbers[face >>> 2]}, ${FACE_OPPOSITE[face & 3] ?? "S1"}\n`;
  yield* stepwise(faceOfTriangle.length, (t) => {
    const face = faceOfTriangle[t] ?? NONE;
    if (face === NONE) return;
    const own = faces[mesh.trianglePatch[t] ?? 0];
    const other = twin[face] ?? NONE;
    own?.FACES.push(line(face));
    if (other !== NONE) own?.BACK.push(line(other));
  });
  // Skip patches without triangles: they have no group, so `patches` does not list them.
  const used = usedGroups(mesh.trianglePatch, mesh.patches);
  const filled = faces.filter((_, patch) => used.has(patch));
  yield patches.flatMap(({ name }, p) =>
    Object.entries(filled[p] ?? {}).flatMap(([side, lines]) =>
      lines.length === 0 ? [] : [`*SURFACE, NAME=${name}_${side}, TYPE=ELEMENT\n${lines.join("")}`],
    ),
  );
}

/** Returns the number of each tetrahedron, from 1, when they are written region by region. */
export function elementNumbers({ tetrahedronRegion, regions }: Mesh): Uint32Array {
  const next = new Uint32Array(regions.length + 1);
  for (const region of tetrahedronRegion) next[region + 1] = (next[region + 1] ?? 0) + 1;
  for (let r = 1; r < next.length; r++) next[r] = (next[r] ?? 0) + (next[r - 1] ?? 0);
  return tetrahedronRegion.map((region) => (next[region] = (next[region] ?? 0) + 1));
}
