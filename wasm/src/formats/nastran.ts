/**
 * Nastran bulk data: GRID points in wide fields of 16 characters, which hold at least ten digits; a CTETRA
 * property PSOLID with a material of the same number per region, and CTRIA3 shells with a PSHELL property
 * of no stiffness per patch. Names are comments, as the format has none. What a material is made of is left to
 * the user.
 */
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { patchGroups, regionGroups, type Group } from "./groups.js";
import type { Held } from "./held.js";
import { noteMerged } from "./merged-points.js";
import { numberRows } from "./number-rows.js";
import { stepwise } from "./steps.js";

/** Properties of shells and solids have their numbers from one set, of eight digits each. */
export const NASTRAN_NUMBERS: Held = { lowestTag: 1, highestTag: 99_999_999, sharesTags: true };

/** The bytes of a bulk data file. Properties have the numbers of their patches and regions. */
export function* writeNastran(mesh: FileMesh, note: Note): Generator<Part, void> {
  const written = new Float64Array(mesh.points.length);
  yield* stepwise(written.length, (i) => (written[i] = Number(wide(mesh.points[i] ?? 0))));
  yield* noteMerged(mesh.points, note, written, `the format has ${WIDE} characters for a coordinate`);
  const regions = yield* regionGroups(mesh, { note });
  const patches = yield* patchGroups(mesh, { note });
  yield [
    "$ Tetrafront\nCEND\nBEGIN BULK\n",
    numberRows(mesh.points, 3, (row, i) => gridCard(i + 1, row)),
    ...cards([...regions, ...patches]),
    "ENDDATA\n",
  ];
}

function cards(groups: readonly Group[]): Part[] {
  let element = 1;
  return groups.flatMap(({ kind, name, nodes, tag: property }) => {
    const isSolid = kind.dimension === 3;
    const card = isSolid ? "CTETRA" : "CTRIA3";
    const material = isSolid ? `PSOLID  ${field(property)}${field(property)}` : `PSHELL  ${field(property)}`;
    return [
      `$ ${isSolid ? "region" : "patch"} ${property}: ${name}\n${material}\n`,
      numberRows(nodes, kind.nodes, (row) => {
        const corners = Array.from(row, (node) => field(node + 1)).join("");
        return `${card.padEnd(8)}${field(element++)}${field(property)}${corners}`;
      }),
    ];
  });
}

/** A whole number in a narrow field; up to 99 999 999 fit. */
function field(value: number): string {
  return String(value).padEnd(8);
}

/** Number and coordinates in two lines of wide fields. */
function gridCard(number: number, point: ArrayLike<number>): string {
  const [x, y, z] = [0, 1, 2].map((axis) => wide(point[axis] ?? 0));
  return `GRID*   ${String(number).padEnd(16)}${"".padEnd(16)}${x}${y}*\n*       ${z}`;
}

const WIDE = 16;

/** As many digits as fit into 16 characters with a point, which a real number must have. */
function wide(value: number): string {
  for (let digits = 17; digits > 1; digits--) {
    const text = real(Number(value.toPrecision(digits)));
    if (text.length <= WIDE) return text.padEnd(WIDE);
  }
  return "0.0".padEnd(WIDE);
}

function real(value: number): string {
  const text = String(value).toUpperCase();
  if (!text.includes("E")) return text.includes(".") ? text : `${text}.0`;
  return text.includes(".") ? text : text.replace("E", ".0E");
}
