/** VTK's cells: adds triangles, polygons and tetrahedra; skips vertices and lines. */
import { plural } from "../base/plural.js";
import { PAUSE, STEP, type Steps, stepwise } from "../base/steps.js";
import { Column } from "./column.js";
import type { MeshBuilder } from "./mesh-builder.js";
import { UNCUT } from "./polygons.js";

const VTK_TRIANGLE = 5;
const VTK_STRIP = 6;
const VTK_POLYGON = 7;
const VTK_PIXEL = 8;
const VTK_QUAD = 9;
const VTK_TETRA = 10;
/** Linear cells with the corners of second-order ones, and the number of nodes of these. */
const SECOND_ORDER: ReadonlyMap<number, readonly [linear: number, corners: number, nodes: number]> = new Map([
  [22, [VTK_TRIANGLE, 3, 6]],
  [24, [VTK_TETRA, 4, 10]],
]);
/** Vertices, lines and empty cells. */
const THIN_CELLS = new Set([0, 1, 2, 3, 4, 21, 35]);

/** Names under which programs store the group of a cell: this package, Gmsh and Medit through meshio, VMTK. */
export const PATCH_ARRAYS: readonly string[] = [
  "patch",
  "gmsh:physical",
  "medit:ref",
  "CellEntityIds",
  "cell_tags",
  "region",
];
export const REGION_ARRAYS: readonly string[] = [
  "region",
  "gmsh:physical",
  "medit:ref",
  "CellEntityIds",
  "cell_tags",
];

/** Returns one number per cell, by array name; undefined if there is no such array. */
export type CellNumbers = (name: string) => Float64Array | undefined;
export type Fail = (message: string) => never;

export interface Cells {
  readonly builder: MeshBuilder;
  readonly fail: Fail;
  /** Patch of a cell that is a triangle; region of a cell that is a tetrahedron. */
  readonly patchOf: (cell: number) => number;
  readonly regionOf: (cell: number) => number;
  /** Names of the arrays with one number per cell that define patches and regions; others are fields. */
  readonly groupArrays: ReadonlySet<string>;
  /** Cells that are tetrahedra, in the order of the mesh. */
  readonly tetrahedra: Column<Uint32Array>;
}

/** Returns the rows of the cells that are tetrahedra, of an array with a row per cell. */
export function* rowsOfTetrahedra(
  values: Float64Array,
  components: number,
  cells: Uint32Array,
): Steps<Float64Array> {
  const rows = new Float64Array(components * cells.length);
  yield* stepwise(cells.length, (t) => {
    const begin = components * (cells[t] ?? 0);
    rows.set(values.subarray(begin, begin + components), components * t);
  });
  return rows;
}

export function cellsOf(builder: MeshBuilder, data: CellNumbers, fail: Fail): Cells {
  const find = (names: readonly string[]) => {
    for (const name of names) {
      const numbers = data(name);
      if (numbers !== undefined) return { name, numbers };
    }
    return undefined;
  };
  const [patch, region] = [find(PATCH_ARRAYS), find(REGION_ARRAYS)];
  const tagOf = (found: NonNullable<typeof patch>, cell: number): number =>
    found.numbers[cell] ?? fail(`cell ${cell} (counted from 0) has no value of "${found.name}"`);
  return {
    builder,
    fail,
    groupArrays: new Set([patch, region].flatMap((found) => (found === undefined ? [] : [found.name]))),
    tetrahedra: new Column(Uint32Array),
    patchOf: (cell) =>
      patch === undefined
        ? builder.patches.of("surface", () => ({ name: "surface", tag: 1 }))
        : builder.patches.tagged(tagOf(patch, cell)),
    regionOf: (cell) => builder.regions.tagged(region === undefined ? 1 : tagOf(region, cell)),
  };
}

/** Calls `each` with all cell numbers in order. Also yields after polygons that took long. */
export function* cellwise(builder: MeshBuilder, count: number, each: (cell: number) => void): Steps<void> {
  const work = { isLong: false };
  builder.onLongWork = () => (work.isLong = true);
  for (let cell = 0; cell < count; cell++) {
    each(cell);
    if (!work.isLong && (cell + 1) % STEP !== 0) continue;
    work.isLong = false;
    yield PAUSE;
  }
}

/** Adds cell number `cell` of the file with these nodes. */
export function addCell(cells: Cells, type: number, nodes: readonly number[], cell: number): void {
  const { builder, fail } = cells;
  if (THIN_CELLS.has(type)) return;
  const wild = nodes.find((node) => !(Number.isInteger(node) && node >= 0 && node < builder.pointCount));
  if (wild !== undefined) fail(`cell ${cell} (counted from 0) refers to node ${wild}, which does not exist`);
  const secondOrder = SECOND_ORDER.get(type);
  if (secondOrder !== undefined) {
    const [linear, corners, count] = secondOrder;
    if (nodes.length !== count)
      fail(`cell ${cell} (counted from 0) of type ${type} has ${plural(nodes.length, "node")}, not ${count}`);
    builder.addSecondOrder(nodes);
    return addCell(cells, linear, nodes.slice(0, corners), cell);
  }
  const [a = 0, b = 0, c = 0, d = 0] = nodes;
  switch (type) {
    case VTK_TETRA:
      if (nodes.length !== 4)
        fail(`cell ${cell} (counted from 0) is a tetrahedron with ${plural(nodes.length, "corner")}`);
      builder.addTetrahedron(a, b, c, d, cells.regionOf(cell));
      cells.tetrahedra.push(cell);
      break;
    case VTK_STRIP:
      addStrip(cells, nodes, cell);
      break;
    case VTK_TRIANGLE:
    case VTK_POLYGON:
    case VTK_QUAD:
      addPolygonCell(cells, nodes, cell);
      break;
    case VTK_PIXEL:
      addPolygonCell(cells, [a, b, d, c], cell);
      break;
    default:
      fail(
        `the file has cells of type ${type}; only triangles, polygons and linear tetrahedra are supported`,
      );
  }
}

function addPolygonCell({ builder, fail, patchOf }: Cells, nodes: readonly number[], cell: number): void {
  if (nodes.length < 3) fail(`cell ${cell} (counted from 0) has ${plural(nodes.length, "corner")}`);
  if (!builder.addPolygon(nodes, patchOf(cell))) {
    fail(`cell ${cell} (counted from 0) ${UNCUT}`);
  }
}

/** Each corner forms a triangle with the two before it; every other triangle has the opposite orientation. */
function addStrip({ builder, patchOf }: Cells, nodes: readonly number[], cell: number): void {
  for (let i = 2; i < nodes.length; i++) {
    const [a = 0, b = 0, c = 0] = nodes.slice(i - 2, i + 1);
    if (i % 2 === 0) builder.addTriangle(a, b, c, patchOf(cell));
    else builder.addTriangle(b, a, c, patchOf(cell));
  }
}
