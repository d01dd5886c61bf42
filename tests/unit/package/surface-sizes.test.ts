/** Sizes proposed for surfaces are those with which the surface is remeshed. */
import { createMesher, type Mesher } from "tetrafront";
import { afterAll, beforeAll, expect, test } from "vitest";

import { sphereSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

function sphere() {
  const surface = sphereSurface(24);
  const trianglePatch = new Uint32Array(surface.triangles.length / 3);
  return { ...surface, trianglePatch, patches: [{ name: "ball", tag: 1 }] };
}

test.each([{}, { maxSize: 0.1 }, { size: 0.15 }, { anglePerEdge: 30 }, { maxVolume: 2e-4 }])(
  "%j predict the remeshed surface and its volume mesh",
  async (options) => {
    const surface = sphere();
    const proposal = await mesher.proposeSurfaceSizes(surface, options);
    const remesh = await mesher.remeshSurface(surface, options);
    const result = await mesher.fillSurface(remesh.mesh);
    const { triangles, tetrahedra } = result.report;
    expect(proposal.triangles / triangles).toBeGreaterThan(0.75);
    expect(proposal.triangles / triangles).toBeLessThan(1.35);
    expect(proposal.tetrahedra / tetrahedra).toBeGreaterThan(0.45);
    expect(proposal.tetrahedra / tetrahedra).toBeLessThan(2);
    expect(proposal.tolerance).toBe(remesh.tolerance);
    // On a sphere, all sizes are about the same.
    expect(proposal.minSize).toBeLessThanOrEqual(proposal.size);
    expect(proposal.minSize).toBeGreaterThan(0.8 * proposal.size);
    expect(proposal.size).toBeLessThanOrEqual(remesh.size);
  },
);

test("a surface that cannot be remeshed is refused", async () => {
  const surface = sphere();
  const open = {
    ...surface,
    triangles: surface.triangles.slice(3),
    trianglePatch: surface.trianglePatch.slice(1),
  };
  await expect(mesher.proposeSurfaceSizes(open)).rejects.toThrow(/not closed/);
  const background = { background: {} } as object;
  await expect(mesher.proposeSurfaceSizes(surface, background)).rejects.toThrow(/no option "background"/);
});
