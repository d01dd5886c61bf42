/** The warning about coordinates whose digits do not suffice, far from the origin. */
import { createMesher, type Mesher, type SurfaceInput } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { boxSurface, sphereSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** A sphere of radius 1 at this distance from the origin, with the digits of a file. */
function sphereAt(distance: number, digits: (x: number) => number): SurfaceInput {
  const { points, triangles } = sphereSurface(3, 1);
  return { points: points.map((x, i) => digits(x + (i % 3 === 0 ? distance : 0))), triangles };
}

const asDouble = (x: number): number => x;

async function warned(surface: SurfaceInput): Promise<readonly string[]> {
  const { report } = await mesher.fillSurface(surface);
  return report.diagnostics.filter(({ code }) => code === "coarse-coordinates").map(({ message }) => message);
}

describe("coarse-coordinates", () => {
  test("warns if the multiples of the last digit are seen in the shape", async () => {
    // Neighbouring numbers are about .002 apart at 1e13 (double), .001 at 1e4 (single).
    const [ofDouble = ""] = await warned(sphereAt(1e13, asDouble));
    expect(ofDouble).toMatch(/double precision/);
    const [ofSingle = ""] = await warned(sphereAt(1e4, Math.fround));
    expect(ofSingle).toMatch(/single precision/);
    // The resolution that the text names is the distance of neighbouring numbers.
    const [, multiple] = /multiples of (\S+?):/.exec(ofSingle) ?? [];
    const next = 1e4 + Number(multiple);
    expect(Math.fround(next)).toBeCloseTo(next, 4);
    expect(Math.fround(1e4 + 0.4 * Number(multiple))).toBe(1e4);
  });

  test("says nothing of coordinates that need no more digits", async () => {
    // Neighbouring numbers in single precision are 1/16 apart there.
    const { points, triangles } = boxSurface(2, [0, 0, 0], [8, 8, 8]);
    expect(await warned({ points: points.map((x) => x + 1e6), triangles })).toEqual([]);
    expect(await warned({ points: points.map((x) => Math.fround(x / 7 + 1e6)), triangles })).toHaveLength(1);
  });

  test("says nothing where the digits suffice", async () => {
    expect(await warned(sphereAt(0, Math.fround))).toEqual([]);
    expect(await warned(sphereAt(1e9, asDouble))).toEqual([]);
  });
});
