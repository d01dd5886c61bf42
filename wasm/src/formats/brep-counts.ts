/**
 * Checks the counts and the shapes of a BREP file before OpenCascade reads them: it would try to read as many entries as a damaged
 * count states, for minutes.
 */
import { type Steps, stepwise } from "../base/steps.js";
import { wrongShapes } from "./brep-shapes.js";
import { failureAt, type ReadFailure } from "./read-result.js";

/** The tables of a file in their order, and the fewest bytes that an entry takes. */
const TABLES: ReadonlyMap<string, number> = new Map([
  ["Locations", 6],
  ["Curve2ds", 8],
  ["Curves", 8],
  ["Polygon3D", 6],
  ["PolygonOnTriangulations", 4],
  ["Surfaces", 8],
  ["Triangulations", 12],
  ["TShapes", 6],
]);
const HEAD = new RegExp(`^\\s*(${[...TABLES.keys()].join("|")})(?:\\s+(.*?))?\\s*$`);

/**
 * Beginnings of a B-spline curve and surface, and where the numbers of poles and knots are among the words. Lines of poles or knots
 * may begin with the same number: only a beginning goes on with as many flags and degrees. Knots increase, so that theirs do not.
 */
const POLES: readonly {
  readonly table: RegExp;
  readonly head: RegExp;
  readonly counts: readonly number[];
}[] = [
  { table: /Curve|Surfaces/, head: /^\s*7(?:\s+[01]){2}\s+\d\d?(?:\s+\d+){2}(?:\s|$)/, counts: [4, 5] },
  {
    table: /Surfaces/,
    head: /^\s*9(?:\s+[01]){4}(?:\s+\d\d?){2}(?:\s+\d+){4}(?:\s|$)/,
    counts: [7, 8, 9, 10],
  },
];

interface Table {
  readonly name: string;
  readonly words: string;
  readonly line: number;
  /** Where its entries begin. */
  readonly begin: number;
}

const REMEDY = "Export the part again as BREP, or in another format.";

/** Returns why a count or a shape of the file cannot be right; undefined if all can. O(n). */
export function* damagedBrep(bytes: Uint8Array): Steps<ReadFailure | undefined> {
  const text = new TextDecoder("latin1").decode(bytes);
  const lines = text.split(/\r\n|\n|\r/);
  const tables: Table[] = [];
  let [at, wrong] = [0, undefined as ReadFailure | undefined];
  yield* stepwise(lines.length, (i) => {
    const words = lines[i] ?? "";
    at += words.length + (text.startsWith("\r\n", at + words.length) ? 2 : 1);
    const [, name, count = ""] = HEAD.exec(words) ?? [];
    if (name !== undefined) tables.push({ name, words: count, line: i + 1, begin: at });
    else wrong ??= wrongPoles(words, tables.at(-1)?.name ?? "", { line: i + 1, left: text.length - at });
  });
  for (const [t, table] of tables.entries()) {
    const end = tables[t + 1]?.begin ?? text.length;
    const found = wrongTable(table, end - table.begin);
    if (found !== undefined) return found;
  }
  if (wrong !== undefined) return wrong;
  const shapes = tables.find(({ name }) => name === "TShapes");
  if (shapes === undefined) return tables.length > 0 ? damaged(lines.length, NO_SHAPES) : undefined;
  const counts = new Map(tables.map(({ name, words }) => [name, Number(words)]));
  const found = yield* wrongShapes(lines, shapes.line, counts);
  return found && damaged(found.line + 1, found.message);
}

const NO_SHAPES = 'it has no table of shapes, "TShapes"; it is truncated';

/** `room`: number of bytes between this table and the next one. */
function wrongTable({ name, words, line }: Table, room: number): ReadFailure | undefined {
  const count = /^\d+$/.test(words) ? Number(words) : NaN;
  if (Number.isNaN(count)) {
    return damaged(line, `expected the number of ${name}, found "${words.slice(0, 24)}"`);
  }
  const most = Math.floor(room / (TABLES.get(name) ?? 1));
  if (count <= most) return undefined;
  return damaged(line, `it announces ${count} ${name}, but what follows has room for at most ${most}`);
}

/** `left`: number of bytes after this line. */
function wrongPoles(
  text: string,
  table: string,
  { line, left }: { readonly line: number; readonly left: number },
): ReadFailure | undefined {
  const kind = POLES.find(({ table: known, head }) => known.test(table) && head.test(text));
  if (kind === undefined) return undefined;
  const words = text.trim().split(/\s+/);
  // The first of the numbers may be on the same line.
  const room = left + text.length;
  const count = kind.counts.map((place) => Number(words[place] ?? 0)).find((found) => found > room);
  if (count === undefined) return undefined;
  return damaged(line, `it announces ${count} poles or knots, but the rest of the file has ${room} bytes`);
}

function damaged(line: number, message: string): ReadFailure {
  return failureAt({ line }, `the file is damaged: ${message}`, REMEDY);
}
