/** The corners A to D of the mapping to the plane, in recorded patches of the gallery. */
import { createMesher, type Mesher } from "tetrafront";
import type { PlanarFront } from "tetrafront/trace";
import { afterAll, beforeAll, expect, it } from "vitest";
import { cornersOfPlane } from "../../../web/teach/player/plane-drawing";
import { recordSurface } from "../../support/recorded-models";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

async function frontsOf(id: string): Promise<readonly PlanarFront[]> {
  const { trace } = await recordSurface(mesher, id);
  return trace.surface?.fronts ?? [];
}

it("the walls of the duct have four corners, as in figure 1 of the paper; its flat ends have none", async () => {
  const fronts = await frontsOf("square-to-circle");
  const walls = fronts.filter(({ isCurved }) => isCurved);
  expect(walls).toHaveLength(4);
  for (const wall of walls) {
    const corners = cornersOfPlane(wall);
    expect(corners.map(({ name }) => name)).toEqual(["A", "B", "C", "D"]);
    const [a, b, c, d] = corners.map(({ at }) => at);
    if (!a || !b || !c || !d) throw new Error("a corner is missing");
    expect(a).toEqual([0, 0]);
    expect(b[1]).toBeCloseTo(0, 9);
    // C and D are at the same height, and the corners are counter-clockwise.
    expect(c[1]).toBeCloseTo(d[1], 9);
    expect(b[0]).toBeGreaterThan(0);
    expect(c[0]).toBeGreaterThan(d[0]);
    // No node of the boundary is outside the quadrilateral.
    for (let node = 0; node < wall.boundaryNodes; node++) {
      const [x = 0, y = 0] = wall.plane.subarray(2 * node, 2 * node + 2);
      const up = y / d[1];
      const slack = 1e-9 * b[0];
      expect(x).toBeGreaterThanOrEqual(up * d[0] - slack);
      expect(x).toBeLessThanOrEqual(b[0] + up * (c[0] - b[0]) + slack);
    }
  }
  for (const flat of fronts.filter(({ isCurved }) => !isCurved)) expect(cornersOfPlane(flat)).toEqual([]);
});

it("a mapped triangle has the corners A, B and D", async () => {
  const fronts = await frontsOf("sphere-in-a-box");
  const mapped = fronts.map(cornersOfPlane).filter((corners) => corners.length > 0);
  expect(mapped.length).toBeGreaterThan(0);
  for (const corners of mapped) expect(corners.map(({ name }) => name)).toEqual(["A", "B", "D"]);
});
