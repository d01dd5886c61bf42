/** One needle among many good triangles: the elements next to it would spoil the mesh, so the surface is remeshed. */
import { meshFile, type MeshFileOptions, type SurfaceInput } from "tetrafront";
import { expect, test } from "vitest";

import { stlText } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

/** Returns a surface in which the triangles beside one edge are divided by a node of that edge, near its end. */
function withNeedle({ points, triangles }: SurfaceInput, place: number): SurfaceInput {
  const [a = 0, b = 0] = triangles;
  const added = points.length / 3;
  const x = (k: number) => (points[3 * a + k] ?? 0) * (1 - place) + (points[3 * b + k] ?? 0) * place;
  const divided: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [...triangles.subarray(t, t + 3)];
    const at = corners.findIndex((node, k) => {
      const next = corners[(k + 1) % 3];
      return (node === a && next === b) || (node === b && next === a);
    });
    const [from = 0, to = 0, apex = 0] = [0, 1, 2].map((k) => corners[(at + k) % 3]);
    divided.push(...(at < 0 ? corners : [from, added, apex, added, to, apex]));
  }
  expect(divided.length).toBe(triangles.length + 6);
  return {
    points: Float64Array.from([...points, x(0), x(1), x(2)]),
    triangles: Uint32Array.from(divided),
  };
}

async function meshed(surface: SurfaceInput, options: MeshFileOptions = {}) {
  const made = await meshFile(stlText(surface), { fileName: "box.stl", ...options });
  if (!made.success) throw new Error(made.message);
  return made;
}

const box = boxSurface(6);

test.each([0.0005, 0.005])("a needle %d of an edge wide is replaced, with a note", async (place) => {
  const { report, notes } = await meshed(withNeedle(box, place));
  expect(report.dihedral.min).toBeGreaterThan(15);
  expect(notes.join("\n")).toMatch(/of 434 triangles (was a needle|were needles)/);
});

test("it stays if the triangles are to be kept, with a warning", async () => {
  const { report, notes } = await meshed(withNeedle(box, 0.005), { surface: "keep", optimization: "none" });
  expect(report.dihedral.min).toBeLessThan(5);
  expect(notes.join("\n")).toContain("poor");
});

test.each([0.05, 0.25])(
  "a needle beside which elements are good, %d of an edge wide, stays",
  async (place) => {
    const { report } = await meshed(withNeedle(box, place));
    expect(report.remesh).toBeUndefined();
    expect(report.dihedral.min).toBeGreaterThan(10);
  },
);
