/**
 * B-spline surfaces through positions of a patch. The positions are even in the parameters of the patch, and the spline of a side
 * depends on the positions of this side only: patches with a common line have the same curve there.
 */
import type { Geom_BSplineCurve, Geom_BSplineSurface } from "replicad-opencascadejs";

import { bytesOfBase64 } from "../../base/base64.js";
import { lengthOf, minus, plus, type Vector } from "../../base/vectors.js";
import type { GridFace } from "./feature.js";
import type { Session } from "./session.js";

type Row = readonly Vector[];
type Matrix = readonly (readonly number[])[];

/** Degree of the splines; rows with fewer positions have a lower one. */
const DEGREE = 5;

const degreeFor = (count: number): number => Math.min(DEGREE, count - 1);

/** Returns knots from 0 to 1 for a spline through `count` even positions: averages of their parameters (de Boor 1978, chapter XIII). */
function knotsFor(count: number): number[] {
  const degree = degreeFor(count);
  const inner = Array.from(
    { length: count - degree - 1 },
    (_, k) => (k + 1 + (degree - 1) / 2) / (count - 1),
  );
  return [...new Array<number>(degree + 1).fill(0), ...inner, ...new Array<number>(degree + 1).fill(1)];
}

/** Returns the values of all basis functions at a parameter (Cox and de Boor). */
function basisAt(knots: readonly number[], degree: number, t: number): number[] {
  const count = knots.length - degree - 1;
  const knot = (k: number): number => knots[k] ?? 1;
  let span = degree;
  while (span < count - 1 && t >= knot(span + 1)) ++span;
  let values = Array.from({ length: knots.length - 1 }, (_, k) => Number(k === span));
  for (let d = 1; d <= degree; ++d)
    values = values.slice(1).map((right, k) => {
      const [left, below, above] = [values[k] ?? 0, knot(k + d) - knot(k), knot(k + d + 1) - knot(k + 1)];
      return (
        (below > 0 ? (left * (t - knot(k))) / below : 0) +
        (above > 0 ? (right * (knot(k + d + 1) - t)) / above : 0)
      );
    });
  return values;
}

/** Returns the inverse of a matrix whose elimination needs no exchange of rows, as those of splines. */
function inverseOf(matrix: Matrix): number[][] {
  const size = matrix.length;
  const rows = matrix.map((row, r) => [...row, ...row.map((_, c) => (c === r ? 1 : 0))]);
  rows.forEach((pivot, p) => {
    const divisor = pivot[p] ?? 1;
    pivot.forEach((value, c) => (pivot[c] = value / divisor));
    rows.forEach((row, r) => {
      const factor = row[p] ?? 0;
      if (r !== p && factor !== 0) row.forEach((value, c) => (row[c] = value - factor * (pivot[c] ?? 0)));
    });
  });
  return rows.map((row) => row.slice(size));
}

const inverses = new Map<number, Matrix>();

/** Returns the matrix that makes poles of `count` even positions. */
function polesOfPositions(count: number): Matrix {
  const known = inverses.get(count);
  if (known) return known;
  const made = inverseOf(positionsOfPoles(count, count));
  inverses.set(count, made);
  return made;
}

function combination(weights: readonly number[], positions: Row): Vector {
  let [x, y, z] = [0, 0, 0];
  positions.forEach((position, k) => {
    const weight = weights[k] ?? 0;
    x += weight * position[0];
    y += weight * position[1];
    z += weight * position[2];
  });
  return [x, y, z];
}

const polesOf = (positions: Row): Vector[] =>
  polesOfPositions(positions.length).map((weights) => combination(weights, positions));

const bases = new Map<string, Matrix>();

/** Returns the matrix that makes `count` even positions on a spline of its poles. */
function positionsOfPoles(poles: number, count: number): Matrix {
  const key = `${poles} ${count}`;
  const known = bases.get(key);
  if (known) return known;
  const knots = knotsFor(poles);
  const made = Array.from({ length: count }, (_, i) => basisAt(knots, degreeFor(poles), i / (count - 1)));
  bases.set(key, made);
  return made;
}

/** Returns `count` even positions on the spline through a row. */
function resampled(row: Row, count: number): Vector[] {
  const poles = polesOf(row);
  return positionsOfPoles(row.length, count).map((weights) => combination(weights, poles));
}

const transposed = (rows: readonly Row[]): Vector[][] =>
  (rows[0] ?? []).map((_, c) => rows.map((row) => row[c] as Vector));

/** Returns x over k: the polynomial in x that is 1 at k and 0 at the whole numbers below. */
const choose = (x: number, k: number): number => (k === 0 ? 1 : (choose(x, k - 1) * (x - k + 1)) / k);

/**
 * Returns the rows of a triangle as rows of equal length; all positions of the last one are the apex. In the triangle, each row is one
 * position shorter than the one before. Short rows are taken from the polynomial through all positions near the apex.
 */
function squareOf(triangle: readonly Row[]): Vector[][] {
  const count = triangle.length;
  const order = Math.min(DEGREE, count - 1);
  const near = triangle.slice(count - 1 - order);
  const cornerAt = (along: number, up: number): Vector =>
    near.reduce<Vector>(
      (sum, row, j) => {
        const weights = row.map(
          (_, i) => choose(along, i) * choose(up, j) * choose(order - along - up, order - i - j),
        );
        return plus(sum, combination(weights, row));
      },
      [0, 0, 0],
    );
  return triangle.map((row, j) => {
    const cells = count - 1 - j;
    if (cells >= order) return resampled(row, count);
    return Array.from({ length: count }, (_, i) => cornerAt((cells * i) / (count - 1), order - cells));
  });
}

/** Returns the positions of a face in rows of equal length; undefined if the text is invalid. */
export function rowsOf({ grid, positions }: GridFace): Vector[][] | undefined {
  const bytes = bytesOfBase64(positions);
  const count = (bytes?.length ?? 0) / 24;
  const isSquare = grid === "square";
  const side = isSquare ? Math.sqrt(count) : (Math.sqrt(8 * count + 1) - 1) / 2;
  if (bytes === undefined || !Number.isInteger(side) || side < 3) return undefined;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = -8;
  const next = (): number => view.getFloat64((at += 8), true);
  const rows = Array.from({ length: side }, (_, j) =>
    Array.from({ length: isSquare ? side : side - j }, (): Vector => [next(), next(), next()]),
  );
  if (!rows.flat(2).every(Number.isFinite)) return undefined;
  return isSquare ? rows : squareOf(rows);
}

/**
 * Returns an upper estimate of the distance of the patch from the surface through its positions: a fourth of that from the
 * surface through every second one. The error of a spline with twice as many pieces is a fourth where curvatures jump, else less.
 * Of an even number of positions, the last is left out.
 */
export function deviationOf(rows: readonly Row[]): number {
  const alongRow = (given: Row): number => {
    const row = given.slice(0, given.length - ((given.length + 1) % 2));
    const between = resampled(
      row.filter((_, i) => i % 2 === 0),
      row.length,
    );
    return Math.max(...row.map((position, i) => lengthOf(minus(position, between[i] ?? position))));
  };
  return Math.max(...[...rows, ...transposed(rows)].map(alongRow)) / 4;
}

/** Makes the curve through a row of positions: the side of the surface through rows that begin with this one. */
export function curveThrough(session: Session, row: Row): Geom_BSplineCurve {
  const { Geom_BSplineCurve, NCollection_Array1_gp_Pnt } = session.kernel;
  const array = session.hold(new NCollection_Array1_gp_Pnt(1, row.length));
  polesOf(row).forEach((pole, p) => array.SetValue(p + 1, session.point(pole)));
  const { knots, multiplicities } = knotArrays(session, row.length);
  return session.hold(new Geom_BSplineCurve(array, knots, multiplicities, degreeFor(row.length), false));
}

/** Makes the surface through rows of positions. */
export function surfaceThrough(session: Session, rows: readonly Row[]): Geom_BSplineSurface {
  const { Geom_BSplineSurface, NCollection_Array2_gp_Pnt } = session.kernel;
  const poles = transposed(transposed(rows.map(polesOf)).map(polesOf));
  const [across, along] = [poles.length, poles[0]?.length ?? 0];
  const array = session.hold(new NCollection_Array2_gp_Pnt(1, across, 1, along));
  poles.forEach((row, r) => row.forEach((pole, c) => array.SetValue(r + 1, c + 1, session.point(pole))));
  const [u, v] = [knotArrays(session, across), knotArrays(session, along)];
  return session.hold(
    new Geom_BSplineSurface(
      array,
      u.knots,
      v.knots,
      u.multiplicities,
      v.multiplicities,
      degreeFor(across),
      degreeFor(along),
      false,
      false,
    ),
  );
}

/** Returns the knots of a spline as the kernel has them: each once. */
function knotArrays(session: Session, count: number) {
  const { NCollection_Array1_double, NCollection_Array1_int } = session.kernel;
  const ends = degreeFor(count) + 1;
  const once = knotsFor(count).slice(ends - 1, 1 - ends);
  const knots = session.hold(new NCollection_Array1_double(1, once.length));
  const multiplicities = session.hold(new NCollection_Array1_int(1, once.length));
  once.forEach((knot, k) => {
    knots.SetValue(k + 1, knot);
    multiplicities.SetValue(k + 1, k === 0 || k === once.length - 1 ? ends : 1);
  });
  return { knots, multiplicities };
}
