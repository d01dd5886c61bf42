/** Conditions that every finished mesh must meet, checked without code of the mesher. */
import type { MeshResult } from "tetrafront";
import { expect } from "vitest";

import { type Boundary, enclosedVolume, defectsOf, meshVolume, NO_DEFECTS } from "./check-mesh.js";

/** Fails unless the mesh is complete and valid and fills `boundary`, by default its own surface. */
export function expectValid({ report, mesh, front }: MeshResult, boundary: Boundary = mesh): void {
  expect(report.diagnostics.filter(({ severity }) => severity === "error")).toEqual([]);
  expect(report.status).toBe("done");
  expect(defectsOf(mesh, boundary)).toEqual(NO_DEFECTS);
  const enclosed = enclosedVolume(boundary);
  expect(Math.abs(meshVolume(mesh) / enclosed - 1)).toBeLessThan(1e-10);
  expect(Math.abs(report.volume / enclosed - 1)).toBeLessThan(1e-10);
  expect(front).toHaveLength(0);
  expect(report.nodes).toBe(mesh.points.length / 3);
  expect(report.tetrahedra).toBe(mesh.tetrahedra.length / 4);
  expect(report.triangles).toBe(mesh.triangles.length / 3);
  expect(report.fingerprint).toMatch(/^[0-9a-f]{16}$/);
}
