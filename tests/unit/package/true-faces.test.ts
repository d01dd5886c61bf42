/** Meshes of CAD files have their nodes on the faces of the file. */
import { beforeAll, describe, expect, test } from "vitest";

import { meshFile, type Mesh } from "../../../wasm/dist/index.js";
import { type Kernel, kernelVolume, stepOf, testKernel } from "../../support/kernel-shapes.js";

const RADIUS = 3;
const SIDE = 10;

let kernel: Kernel;
let step: Uint8Array;
let exactVolume = 0;

/** A cube minus a cylinder through its middle, along z. */
beforeAll(async () => {
  kernel = await testKernel();
  const box = new kernel.BRepPrimAPI_MakeBox(new kernel.gp_Pnt(0, 0, 0), SIDE, SIDE, SIDE).Shape();
  const axes = new kernel.gp_Ax2(new kernel.gp_Pnt(SIDE / 2, SIDE / 2, -1), new kernel.gp_Dir(0, 0, 1));
  const tool = new kernel.BRepPrimAPI_MakeCylinder(axes, RADIUS, SIDE + 2).Shape();
  const shape = new kernel.BRepAlgoAPI_Cut(box, tool, new kernel.Message_ProgressRange()).Shape();
  step = stepOf(kernel, shape);
  exactVolume = kernelVolume(kernel, shape);
}, 30_000);

async function meshed(options: Parameters<typeof meshFile>[1] = {}) {
  const made = await meshFile(step, { fileName: "part.step", ...options });
  if (!made.success) throw new Error(made.message);
  return made;
}

/** Distance of a position from the nearest face of the cube or the cylinder. `scale`: lengths there / millimetres. */
function distanceFromFaces([x = 0, y = 0, z = 0]: readonly number[], scale = 1): number {
  const side = SIDE * scale;
  const planes = [x, y, z].flatMap((value) => [Math.abs(value), Math.abs(value - side)]);
  const hole = Math.abs(Math.hypot(x - side / 2, y - side / 2) - RADIUS * scale);
  return Math.min(hole, ...planes);
}

function largestDistance({ points, triangles }: Mesh, scale = 1): number {
  let largest = 0;
  for (const node of triangles)
    largest = Math.max(largest, distanceFromFaces([...points.subarray(3 * node, 3 * node + 3)], scale));
  return largest;
}

const volumeOf = ({ report }: Awaited<ReturnType<typeof meshed>>) =>
  report.regions.reduce((sum, { volume }) => sum + volume, 0);

describe("a cube minus a cylinder", () => {
  test("has all its boundary nodes on the faces", async () => {
    const { mesh, report, notes } = await meshed();
    expect(largestDistance(mesh)).toBeLessThan(1e-9 * SIDE);
    const nodes = new Set(mesh.triangles).size;
    expect(report.remesh?.placement).toMatchObject({ placed: nodes, unplaced: 0 });
    expect(notes.join()).toMatch(/ nodes on the true faces \(moved by at most /);
  });

  test("encloses the volume at second order", async () => {
    // The automatic tolerance would limit the edges around the hole to the same length in both meshes.
    const errorAt = async (size: number) =>
      Math.abs(volumeOf(await meshed({ size, tolerance: 1 })) - exactVolume);
    const [more, less] = [await errorAt(1.6), await errorAt(0.8)];
    // Half the size: second order divides the error by 4.
    expect(less).toBeLessThan(more / 3);
    expect(less).toBeLessThan(6e-3 * exactVolume);
  });

  test("has the middles of its curved edges on the faces", async () => {
    const { mesh } = await meshed();
    const { edges, middles } = mesh.trueEdges ?? { edges: new Uint32Array(), middles: new Float64Array() };
    expect(edges.length).toBeGreaterThan(0);
    expect(middles).toHaveLength((3 * edges.length) / 2);
    for (let e = 0; e < edges.length / 2; e++) {
      const middle = [...middles.subarray(3 * e, 3 * e + 3)];
      const [x = 0, y = 0] = middle;
      expect(Math.abs(Math.hypot(x - SIDE / 2, y - SIDE / 2) - RADIUS)).toBeLessThan(1e-9 * SIDE);
    }
  });

  test("is in other units too", async () => {
    const { mesh } = await meshed({ units: "m" });
    expect(largestDistance(mesh, 1e-3)).toBeLessThan(1e-12 * SIDE);
  });

  test("keeps the triangles of the kernel if they are asked for", async () => {
    const { report, mesh } = await meshed({ surface: "keep" });
    expect(report.remesh).toBeUndefined();
    expect(mesh.trueEdges).toBeUndefined();
  });
});
