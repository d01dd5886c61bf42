/**
 * Writes OpenFOAM: the folder `constant/polyMesh` in a zip, to be unpacked in a case. Faces are in OpenFOAM's
 * order. Inner faces come first, cell by cell towards higher neighbours (upper triangular); their normals point
 * from the lower to the higher cell. The faces of each patch follow; their normals point outward. Regions are cell
 * zones, and patches between two regions are face zones. Faces without a patch, as in a partial mesh, form
 * `defaultFaces`.
 */
import { PAUSE, type Steps, stepwise } from "../base/steps.js";
import type { Mesh } from "../mesh/mesh.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { patchGroups, regionGroups, usedGroups } from "./groups.js";
import { coordinates, numberRows } from "./number-rows.js";
import { noteDuplicates, noteFreeTriangles, noteUnnamedFaces } from "./outer-faces.js";
import { cornersOf, NONE, type TetFaces, validFaces } from "./tet-faces.js";
import { zipped } from "./zip.js";

/** Consecutive faces of a patch. */
interface FaceRange {
  readonly name: string;
  readonly begin: number;
  readonly count: number;
}

interface PolyMesh {
  /** Faces 4 t + f of tetrahedra, in OpenFOAM's order. */
  readonly faces: Uint32Array;
  /** Per inner face, in the same order. */
  readonly neighbours: Uint32Array;
  readonly patches: readonly FaceRange[];
  readonly zones: readonly { readonly name: string; readonly faces: Uint32Array }[];
}

/** Returns the bytes of the zip. */
export function* writeOpenFoam(mesh: Mesh, note: Note): Generator<Part, void> {
  const poly = yield* polyMesh(mesh, note);
  yield PAUSE;
  const owners = poly.faces.map((face) => face >>> 2);
  const counts =
    `note "nPoints:${mesh.points.length / 3} nCells:${mesh.tetrahedra.length / 4} ` +
    `nFaces:${poly.faces.length} nInternalFaces:${poly.neighbours.length}";\n`;
  const files: Record<string, Part> = {
    points: list(
      "vectorField",
      "points",
      mesh.points.length / 3,
      numberRows(mesh.points, 3, (row) => `(${coordinates(row)})`),
    ),
    faces: list(
      "faceList",
      "faces",
      poly.faces.length,
      numberRows(poly.faces, 1, ([face = 0]) => `3${inBrackets(cornersOf(mesh.tetrahedra, face))}`),
    ),
    owner: list("labelList", "owner", owners.length, labels(owners), counts),
    neighbour: list("labelList", "neighbour", poly.neighbours.length, labels(poly.neighbours), counts),
    boundary: list("polyBoundaryMesh", "boundary", poly.patches.length, poly.patches.map(patchEntry)),
    cellZones: yield* cellZones(mesh, note),
    faceZones: list("regIOobject", "faceZones", poly.zones.length, poly.zones.map(zoneEntry)),
  };
  yield* zipped(
    Object.entries(files).map(([name, part]) => ({ fileName: `constant/polyMesh/${name}`, parts: [part] })),
  );
}

function* polyMesh(mesh: Mesh, note: Note): Steps<PolyMesh> {
  const found = yield* validFaces(mesh);
  noteFreeTriangles(found.faceOfTriangle.filter((face) => face === NONE).length, note);
  const isDuplicate = (t: number, face: number) => face !== NONE && found.triangle[face] !== t;
  noteDuplicates(found.faceOfTriangle.filter((face, t) => isDuplicate(t, face)).length, note);
  const inner = yield* innerFaces(found.twin);
  const outside: number[] = [];
  let indices: Uint32Array | undefined;
  const patches: FaceRange[] = [];
  const zones: { name: string; faces: Uint32Array }[] = [];
  const names = yield* namesOf(mesh, note);
  const byPatch = yield* membersOf(mesh.trianglePatch, mesh.patches.length);
  byPatch.forEach((own, patch) => {
    const kept = own.filter((t) => !isDuplicate(t, found.faceOfTriangle[t] ?? NONE));
    const sides = kept.map((t) => found.faceOfTriangle[t] ?? NONE).filter((face) => face !== NONE);
    const outer = sides.filter((face) => found.twin[face] === NONE);
    const between = sides.filter((face) => found.twin[face] !== NONE);
    const name = names[patch] ?? `patch_${patch + 1}`;
    if (outer.length > 0) {
      patches.push({ name, begin: inner.length + outside.length, count: outer.length });
    }
    for (const face of outer) outside.push(face);
    if (between.length === 0) return;
    const known = (indices ??= indexByFace(inner, found.twin.length));
    const zone = Uint32Array.from(between, (face) => known[lowerHalfFace(face, found.twin)] ?? 0);
    zones.push({ name, faces: zone.sort() });
  });
  const unnamed = yield* unnamedFaces(found);
  if (unnamed.length > 0) {
    const name = "defaultFaces";
    patches.push({ name, begin: inner.length + outside.length, count: unnamed.length });
    noteUnnamedFaces(unnamed.length, name, note);
  }
  yield PAUSE;
  const faces = new Uint32Array(inner.length + outside.length + unnamed.length);
  faces.set(inner);
  faces.set(outside, inner.length);
  faces.set(unnamed, inner.length + outside.length);
  yield PAUSE;
  const neighbours = inner.map((face) => (found.twin[face] ?? 0) >>> 2);
  return { faces, neighbours, patches, zones };
}

/** Returns, of the two half-faces of an inner face, the one of the lower cell. */
function lowerHalfFace(face: number, twin: Uint32Array): number {
  return Math.min(face, twin[face] ?? face);
}

/** Returns the inner faces cell by cell, ordered by their higher neighbour. */
function* innerFaces(twin: Uint32Array): Steps<Uint32Array> {
  const inner = new Uint32Array(twin.length / 2);
  let count = 0;
  yield* stepwise(twin.length / 4, (t) => {
    const begin = 4 * t;
    const own = [begin, begin + 1, begin + 2, begin + 3].filter((face) => {
      const other = twin[face] ?? NONE;
      return other !== NONE && other > face;
    });
    own.sort((a, b) => (twin[a] ?? 0) - (twin[b] ?? 0));
    for (const face of own) inner[count++] = face;
  });
  return inner.subarray(0, count);
}

/** Inverts a list of distinct faces: index in the list by face. */
function indexByFace(faces: Uint32Array, faceCount: number): Uint32Array {
  const indices = new Uint32Array(faceCount);
  faces.forEach((face, index) => (indices[face] = index));
  return indices;
}

/** Returns the faces of exactly one tetrahedron without a triangle. */
function* unnamedFaces({ twin, triangle }: TetFaces): Steps<number[]> {
  const unnamed: number[] = [];
  yield* stepwise(twin.length, (face) => {
    if (twin[face] === NONE && triangle[face] === NONE) unnamed.push(face);
  });
  return unnamed;
}

/** Returns the elements of each group, in their order. */
function* membersOf(owners: Uint32Array, groups: number): Steps<number[][]> {
  const members = Array.from({ length: groups }, (): number[] => []);
  yield* stepwise(owners.length, (element) => members[owners[element] ?? 0]?.push(element));
  return members;
}

/** Returns names that OpenFOAM accepts, by patch index; undefined for patches without triangles. */
function* namesOf(mesh: Mesh, note: Note): Steps<(string | undefined)[]> {
  const used = usedGroups(mesh.trianglePatch, mesh.patches);
  const names = (yield* patchGroups(mesh, { toPlain: word, note })).map(({ name }) => name);
  return mesh.patches.map((_, patch) => (used.has(patch) ? names.shift() : undefined));
}

function word(name: string): string {
  const plain = name.replace(/[^A-Za-z0-9_.-]+/g, "_");
  return /^[A-Za-z_]/.test(plain) ? plain : `_${plain}`;
}

function header(kind: string, object: string, note = ""): string {
  return (
    `FoamFile\n{\nversion 2.0;\nformat ascii;\nclass ${kind};\n${note}` +
    `location "constant/polyMesh";\nobject ${object};\n}\n`
  );
}

function list(kind: string, object: string, count: number, entries: Iterable<Part>, note = ""): Part {
  return [header(kind, object, note), `${count}\n(\n`, entries, ")\n"];
}

function inBrackets(row: readonly number[]): string {
  return `(${row.join(" ")})`;
}

function labels(values: Uint32Array): Iterable<string> {
  return numberRows(values, 1, (row) => String(row[0] ?? 0));
}

function patchEntry({ name, begin, count }: FaceRange): string {
  return `${name}\n{\ntype patch;\nnFaces ${count};\nstartFace ${begin};\n}\n`;
}

function zoneEntry({ name, faces }: { readonly name: string; readonly faces: Uint32Array }): string {
  const flips = `List<bool> ${faces.length}{0}`;
  return (
    `${name}\n{\ntype faceZone;\nfaceLabels List<label> ${faces.length}\n(\n${[...labels(faces)].join("")});\n` +
    `flipMap ${flips};\n}\n`
  );
}

function* cellZones(mesh: Mesh, note: Note): Steps<Part> {
  const cells = yield* membersOf(mesh.tetrahedronRegion, mesh.regions.length);
  const filled = cells.filter((own) => own.length > 0);
  const groups = yield* regionGroups(mesh, { toPlain: word, note });
  const entries = groups.map(({ name }, r): Part => {
    const own = Uint32Array.from(filled[r] ?? []);
    return [`${name}\n{\ntype cellZone;\ncellLabels List<label> ${own.length}\n(\n`, labels(own), ");\n}\n"];
  });
  return list("regIOobject", "cellZones", entries.length, entries);
}
