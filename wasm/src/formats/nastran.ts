/**
 * Writes Nastran bulk data: GRID points in wide fields of 16 characters, which hold at least ten digits; per
 * region, CTETRA elements with a PSOLID property and a material of the same number; per patch, CTRIA3 or CTRIA6 shells with a
 * PSHELL property without stiffness. Names are comments, because the format has none. Material properties are left
 * to the user.
 */
import { stepwise } from "../base/steps.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FormatLimits } from "./format-limits.js";
import { type Group, patchGroups, regionGroups } from "./groups.js";
import type { WrittenMesh } from "./second-order.js";
import { noteMerged } from "./merged-points.js";
import { numberRows } from "./number-rows.js";

/** Properties of shells and solids share one set of numbers, of at most eight digits. */
export const NASTRAN_NUMBERS: FormatLimits = { minTag: 1, maxTag: 99_999_999, hasSharedTags: true };

/** Returns the bytes of a bulk data file. Properties have the tags of their patches and regions. */
export function* writeNastran(mesh: WrittenMesh, note: Note): Generator<Part, void> {
  const written = new Float64Array(mesh.points.length);
  yield* stepwise(written.length, (i) => (written[i] = Number(wide(mesh.points[i] ?? 0))));
  yield* noteMerged(mesh.points, note, written, `the format has ${WIDE} characters per coordinate`);
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
    const card = isSolid ? "CTETRA" : kind.nodes === 6 ? "CTRIA6" : "CTRIA3";
    const material = isSolid ? `PSOLID  ${field(property)}${field(property)}` : `PSHELL  ${field(property)}`;
    return [
      `$ ${isSolid ? "region" : "patch"} ${property}: ${name}\n${material}\n`,
      numberRows(nodes, kind.nodes, (row) => {
        const fields = Array.from(row, (node) => field(node + 1));
        const first = `${card.padEnd(8)}${field(element++)}${field(property)}${fields.slice(0, 6).join("")}`;
        // A card has eight fields per line; "+" links it with its continuation.
        return fields.length > 6 ? `${first}+\n+       ${fields.slice(6).join("")}` : first;
      }),
    ];
  });
}

/** Formats a whole number for a narrow field; the largest is 99 999 999. */
function field(value: number): string {
  return String(value).padEnd(8);
}

/** Formats a number and coordinates as two lines of wide fields. */
function gridCard(number: number, point: ArrayLike<number>): string {
  const [x, y, z] = [0, 1, 2].map((axis) => wide(point[axis] ?? 0));
  return `GRID*   ${String(number).padEnd(16)}${"".padEnd(16)}${x}${y}*\n*       ${z}`;
}

const WIDE = 16;

/**
 * Formats a number with as many digits as fit into 16 characters, with the decimal point that a real number
 * requires.
 */
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
