/** Positions of a sewn patch as rows, and how far a surface through them may be from the patch. */
import { base64Of, deviationOf, type GridFace, rowsOf } from "tetrafront/internal";
import { expect, test } from "vitest";

type Position = readonly [number, number, number];
type Surface = (u: number, v: number) => Position;

/** Returns even positions of a square, or of a triangle, whose rows get shorter. */
function faceOn(surface: Surface, grid: GridFace["grid"], cells: number): GridFace {
  const rows = Array.from({ length: cells + 1 }, (_, j) =>
    Array.from({ length: grid === "square" ? cells + 1 : cells + 1 - j }, (__, i) =>
      surface(i / cells, j / cells),
    ),
  );
  return { grid, positions: base64Of(new Uint8Array(new Float64Array(rows.flat(2)).buffer)) };
}

const quintic: Surface = (u, v) => [u, v, u ** 5 - u ** 2 * v ** 3 + v];
const round: Surface = (u, v) => [Math.cos(u), Math.sin(u), v];
const kinked: Surface = (u, v) => [u, v, Math.abs(u - 0.45)];

const largest = (surface: Surface, grid: GridFace["grid"], cells: number): number =>
  deviationOf(rowsOf(faceOn(surface, grid, cells)) ?? []);

test("the rows of a square are its positions", () => {
  const rows = rowsOf(faceOn(quintic, "square", 8));
  expect(rows).toHaveLength(9);
  rows?.forEach((row, j) => {
    expect(row).toHaveLength(9);
    row.forEach((position, i) => expect(position).toEqual(quintic(i / 8, j / 8)));
  });
});

test("the rows of a triangle have equal lengths, are on it, and end in its apex", () => {
  const cells = 10;
  const rows = rowsOf(faceOn(quintic, "triangle", cells)) ?? [];
  expect(rows).toHaveLength(cells + 1);
  rows.forEach((row, j) => {
    expect(row).toHaveLength(cells + 1);
    const v = j / cells;
    row.forEach((position, i) => {
      const expected = quintic((i / cells) * (1 - v), v);
      position.forEach((part, k) => expect(part).toBeCloseTo(expected[k] ?? 9, 9));
    });
  });
});

test("polynomials of the splines' degree do not deviate, and others the less, the more positions there are", () => {
  for (const grid of ["square", "triangle"] as const) {
    expect(largest(quintic, grid, 24)).toBeLessThan(1e-9);
    const [coarse, fine] = [largest(round, grid, 8), largest(round, grid, 16)];
    expect(coarse).toBeGreaterThan(0);
    expect(fine).toBeLessThan(coarse / 10);
  }
  // Of an even number of positions, too.
  expect(largest(quintic, "square", 23)).toBeLessThan(1e-9);
  expect(largest(kinked, "square", 24)).toBeGreaterThan(1e-3);
  expect(largest(kinked, "square", 96)).toBeLessThan(largest(kinked, "square", 24) / 2);
});

test("damaged positions give no rows", () => {
  const { positions } = faceOn(quintic, "square", 4);
  const notFinite = faceOn((u, v) => [u, v, Number.NaN], "square", 4);
  for (const face of [
    { grid: "square", positions: "%" },
    { grid: "square", positions: positions.slice(0, 64) },
    { grid: "triangle", positions },
    notFinite,
  ] as const)
    expect(rowsOf(face)).toBeUndefined();
});
