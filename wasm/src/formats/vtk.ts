/**
 * Writes legacy VTK files, which nearly every program that supports VTK reads: like VTU, an unstructured grid of
 * the tetrahedra and the boundary's triangles, with `region` and `patch` as cell data. Text in the old form, with
 * the number of nodes before each cell, because Gmsh reads no other. The title holds the names, if all fit.
 */
import { inPieces, type Steps, stepwise } from "../base/steps.js";
import type { Mesh, MeshGroup, NodeData } from "../mesh/mesh.js";
import type { Part } from "./bytes.js";
import { cellDataOf } from "./element-data.js";
import type { Note } from "./file-format.js";
import { noteNames } from "./groups.js";
import type { WrittenMesh } from "./second-order.js";
import { allNameLines, NAME_BREAK } from "./name-lines.js";
import { coordinates, numberRows } from "./number-rows.js";

/** VTK's types of linear cells; their node orders equal ours. */
const VTK_TRIANGLE = 5;
const VTK_TETRA = 10;
/** Second-order cells; their node orders equal ours too. */
const VTK_QUADRATIC_TRIANGLE = 22;
const VTK_QUADRATIC_TETRA = 24;

/** Returns the bytes of a legacy VTK file. */
export function* writeVtk(mesh: WrittenMesh, note: Note): Generator<Part, void> {
  const { points } = mesh;
  const { tetrahedra, triangles, perTetrahedron, perTriangle } = yield* vtkCellNodes(mesh);
  const { count, types, regions, patches } = vtkCellData(mesh);
  const perCell = (values: CellValues) =>
    inPieces(count, (begin, end) => `${values(begin, end).join("\n")}\n`);
  yield [
    `# vtk DataFile Version 3.0\n${title(mesh, note)}\nASCII\nDATASET UNSTRUCTURED_GRID\n`,
    `POINTS ${points.length / 3} double\n`,
    numberRows(points, 3, (row) => coordinates(row)),
    `CELLS ${count} ${count + tetrahedra.length + triangles.length}\n`,
    numberRows(tetrahedra, perTetrahedron, (row) => `${perTetrahedron} ${row.join(" ")}`),
    numberRows(triangles, perTriangle, (row) => `${perTriangle} ${row.join(" ")}`),
    `CELL_TYPES ${count}\n`,
    perCell(types),
    `CELL_DATA ${count}\nSCALARS region int 1\nLOOKUP_TABLE default\n`,
    perCell(regions),
    "SCALARS patch int 1\nLOOKUP_TABLE default\n",
    perCell(patches),
    ...numberFields(yield* vtkElementData(mesh, note), count),
    ...pointData(mesh),
  ];
}

function pointData({ points, nodeData }: Mesh): Part[] {
  const count = points.length / 3;
  return nodeData.size === 0 ? [] : [`POINT_DATA ${count}\n`, ...numberFields(nodeData, count)];
}

/** Writes values of `count` nodes or cells. In their names, blanks and other separators are encoded like %20. */
function numberFields(data: ReadonlyMap<string, NodeData>, count: number): Part[] {
  if (data.size === 0) return [];
  const arrays = [...data].flatMap(([name, { components, values }]): Part[] => [
    `${nameWord(name)} ${components} ${count} double\n`,
    numberRows(values, components, (row) => coordinates(row).replaceAll("NaN", "nan")),
  ]);
  return [`FIELD numbers ${data.size}\n`, ...arrays];
}

function nameWord(name: string): string {
  const codes = (text: string) =>
    Array.from(new TextEncoder().encode(text), (byte) => `%${byte.toString(16).padStart(2, "0")}`).join("");
  return name === "" ? "numbers" : name.replace(/[^!#$&-~]+/g, codes);
}

/** Returns a title line of at most 255 bytes. */
function title(mesh: Mesh, note: Note): string {
  const cut: string[] = [];
  const lines = allNameLines(mesh, (message) => cut.push(message));
  const text = ["Tetrafront", ...lines].join(NAME_BREAK);
  const isTold = cut.length === 0 && !lines.some((line) => line.includes(NAME_BREAK.trim()));
  if (isTold && new TextEncoder().encode(text).length < 256) return text;
  noteNames(mesh.patches, note);
  noteNames(mesh.regions, note);
  return "Tetrafront";
}

/** Names of the arrays that define the groups. */
const GROUP_NAMES: ReadonlySet<string> = new Set(["region", "patch"]);

/**
 * Returns the values of all cells by name, tetrahedra first. A field with the name of an array that defines groups gets another name,
 * because a reader would take it for the groups.
 */
export function* vtkElementData(mesh: Mesh, note: Note): Steps<ReadonlyMap<string, NodeData>> {
  const data = yield* cellDataOf(mesh);
  const named = new Map<string, NodeData>();
  for (const [name, values] of data) {
    let own = name;
    while (GROUP_NAMES.has(own) || (own !== name && data.has(own))) own = `${own} field`;
    if (own !== name)
      note(`the field "${name}" is written as "${own}": in the file, "${name}" holds the groups`);
    named.set(own, values);
  }
  return named;
}

/** Returns one value for each cell from `begin` to `end` - 1. */
export type CellValues = (begin: number, end: number) => Int32Array;

/** Cell data of both VTK formats: the tetrahedra, then the triangles. They are made when they are requested. */
export interface VtkCellData {
  readonly count: number;
  readonly types: CellValues;
  /** Per cell: the tag of its region or patch; 0 for cells of the other kind. */
  readonly regions: CellValues;
  readonly patches: CellValues;
}

/** Nodes of the cells, with those at the middles of edges after the corners of each cell. */
export interface VtkCellNodes {
  readonly tetrahedra: Uint32Array;
  readonly triangles: Uint32Array;
  readonly perTetrahedron: number;
  readonly perTriangle: number;
}

export function* vtkCellNodes({ tetrahedra, triangles, midNodes }: WrittenMesh): Steps<VtkCellNodes> {
  if (midNodes === undefined) return { tetrahedra, triangles, perTetrahedron: 4, perTriangle: 3 };
  return {
    tetrahedra: yield* interleaved(tetrahedra, 4, midNodes.tetrahedra, 6),
    triangles: yield* interleaved(triangles, 3, midNodes.triangles, 3),
    perTetrahedron: 10,
    perTriangle: 6,
  };
}

function* interleaved(
  corners: Uint32Array,
  cornerCount: number,
  middles: Uint32Array,
  middleCount: number,
): Steps<Uint32Array> {
  const width = cornerCount + middleCount;
  const all = new Uint32Array(corners.length + middles.length);
  yield* stepwise(all.length / width, (cell) => {
    all.set(corners.subarray(cornerCount * cell, cornerCount * (cell + 1)), width * cell);
    all.set(middles.subarray(middleCount * cell, middleCount * (cell + 1)), width * cell + cornerCount);
  });
  return all;
}

/** `tets` and `regionOf`: number of tetrahedra, and the region of each, if the mesh has no arrays of them. */
export function vtkCellData(
  mesh: WrittenMesh,
  tets = mesh.tetrahedronRegion.length,
  regionOf = (t: number) => mesh.tetrahedronRegion[t] ?? 0,
): VtkCellData {
  const { trianglePatch } = mesh;
  const [tetra, triangle] =
    mesh.midNodes === undefined ? [VTK_TETRA, VTK_TRIANGLE] : [VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE];
  const perCell = (ofTetrahedron: (t: number) => number, ofTriangle: (t: number) => number): CellValues => {
    return (begin, end) => {
      const values = new Int32Array(end - begin);
      for (let cell = begin; cell < end; cell++) {
        values[cell - begin] = cell < tets ? ofTetrahedron(cell) : ofTriangle(cell - tets);
      }
      return values;
    };
  };
  const tags = (groups: readonly MeshGroup[]) => Int32Array.from(groups, ({ tag }) => tag);
  const [regionTags, patchTags] = [tags(mesh.regions), tags(mesh.patches)];
  const none = () => 0;
  return {
    count: tets + trianglePatch.length,
    types: perCell(
      () => tetra,
      () => triangle,
    ),
    regions: perCell((t) => regionTags[regionOf(t)] ?? 0, none),
    patches: perCell(none, (t) => patchTags[trianglePatch[t] ?? 0] ?? 0),
  };
}
