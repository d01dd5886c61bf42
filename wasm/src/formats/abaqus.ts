/**
 * Abaqus and CalculiX `.inp`: tetrahedra C3D4 in one element set and solid section per region, with the
 * region's name as material, and per patch a node set and a surface of element faces: boundary conditions
 * and loads refer to these by name. Walls between regions have a surface for either side. What a material is made of is
 * left to the user.
 */
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { patchGroups, regionGroups, usedGroups, type Group, type Naming } from "./groups.js";
import { coordinates, fromOne, numberRows } from "./number-rows.js";
import { stepwise } from "./steps.js";
import { NONE, tetFaces } from "./tet-faces.js";

/** By the corner opposite; Abaqus numbers faces by their corners: S1 is 1 2 3, S2 1 2 4, S3 2 3 4, S4 1 3 4. */
const SIDE_OPPOSITE = ["S3", "S4", "S2", "S1"];
/** No data line may have more numbers. */
const PER_LINE = 16;
/** Names of 80 characters with a letter set before and `_FACES` behind. */
const NAMING: Naming = { plain: plainName, longest: 72, isCaseless: true };

/** The bytes of an Abaqus input file. Triangles of no tetrahedron are in the node sets only. */
export function* writeAbaqus(mesh: FileMesh, note: Note): Generator<Part, void> {
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

/** A letter, then letters, digits and underscores: what every reader of the format takes. */
function plainName(name: string): string {
  const plain = name.replace(/[^A-Za-z0-9_]+/g, "_");
  return /^[A-Za-z]/.test(plain) ? plain : `N_${plain}`;
}

/** Elements are numbered from 1 through the regions, as `elementNumbers` says. */
function elementSets(regions: readonly Group[]): Part[] {
  let number = 1;
  return regions.flatMap(({ name, nodes }) => [
    `*ELEMENT, TYPE=C3D4, ELSET=${name}\n`,
    numberRows(nodes, 4, (row) => `${number++}, ${fromOne(row, ", ")}`),
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

function* surfaces(mesh: FileMesh, patches: readonly Group[]): Generator<Part, void> {
  const { faceOfTriangle, twin } = yield* tetFaces(mesh);
  const numbers = elementNumbers(mesh);
  /** By patch: the faces that its triangles look out of, and those on the other side of walls. */
  const sides = mesh.patches.map(() => ({ FACES: [] as string[], BACK: [] as string[] }));
  const line = (face: number) => `${numbers[face >>> 2]}, ${SIDE_OPPOSITE[face & 3] ?? "S1"}\n`;
  yield* stepwise(faceOfTriangle.length, (t) => {
    const face = faceOfTriangle[t] ?? NONE;
    if (face === NONE) return;
    const own = sides[mesh.trianglePatch[t] ?? 0];
    const other = twin[face] ?? NONE;
    own?.FACES.push(line(face));
    if (other !== NONE) own?.BACK.push(line(other));
  });
  // Patches without triangles have no group, and no lines here.
  const used = usedGroups(mesh.trianglePatch, mesh.patches);
  const filled = sides.filter((_, patch) => used.has(patch));
  yield patches.flatMap(({ name }, p) =>
    Object.entries(filled[p] ?? {}).flatMap(([side, lines]) =>
      lines.length === 0 ? [] : [`*SURFACE, NAME=${name}_${side}, TYPE=ELEMENT\n${lines.join("")}`],
    ),
  );
}

/** The number of each tetrahedron when they are written region by region, from 1. */
export function elementNumbers({ tetrahedronRegion, regions }: FileMesh): Uint32Array {
  const next = new Uint32Array(regions.length + 1);
  for (const region of tetrahedronRegion) next[region + 1] = (next[region + 1] ?? 0) + 1;
  for (let r = 1; r < next.length; r++) next[r] = (next[r] ?? 0) + (next[r - 1] ?? 0);
  return tetrahedronRegion.map((region) => (next[region] = (next[region] ?? 0) + 1));
}
