import type { CallProgress } from "tetrafront";

/** Progress of a call that has made nothing yet. */
export const progressAt = (fraction: number): CallProgress => ({
  phase: "check",
  fraction,
  nodes: 0,
  triangles: 0,
  tetrahedra: 0,
  frontFaces: 0,
  expectedTetrahedra: 0,
  exactFillFraction: 0,
  elapsedSeconds: 0,
});
