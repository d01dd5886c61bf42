/** Whether the triangles of a surface are fit for a mesh that keeps them. */
import { inSteps } from "../calls/yielder.js";
import { refuse } from "../diagnostics/mesher-error.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { type TriangleShapes, triangleShapes } from "../mesh/triangle-shapes.js";
import { checkSurface } from "./input-checks.js";

/**
 * Measures the triangles of a surface: `meshFile` and `meshSurface` replace all of them by default unless they are fit. O(n).
 * Rejects with `invalid-input` if the arrays are inconsistent.
 */
export async function measureTriangles(surface: SurfaceInput): Promise<TriangleShapes> {
  refuse(checkSurface(surface));
  return inSteps(triangleShapes(surface));
}
