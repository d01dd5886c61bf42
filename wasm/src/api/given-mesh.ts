/** Meshes from files and improved meshes, in the form in which a run returns its mesh. */
import * as v from "valibot";
import { type Steps, stepwise } from "../base/steps.js";
import { checkArgument } from "../calls/argument-checks.js";
import { doubles, integers } from "../calls/schemas.js";
import { inSteps } from "../calls/yielder.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { boundaryOf } from "../formats/boundary.js";
import { usedGroups } from "../formats/groups.js";
import { cornersOf, NONE, tetFaces } from "../formats/tet-faces.js";
import { NO_REGION } from "../generated/constants.js";
import type { MeshGroup, Mesh } from "../mesh/mesh.js";
import type { MeshImprovement } from "../mesh/improvement.js";
import type { MeshInspection } from "../mesh/inspection.js";
import { checkFileMesh } from "../mesh/mesh-checks.js";
import { poorElementWarnings } from "../mesh/quality-warnings.js";
import type { PatchQuality } from "../mesh/quality.js";
import type { MeshReport, MeshResult } from "../mesh/report.js";
import { emptyReport, emptyResult, regionsOf } from "./report.js";
import { renumbered } from "./improvement.js";

/** A volume mesh with the triangles between its regions, and around them. */
export interface MeshWithBoundary {
  /**
   * With boundary faces, interfaces, and the other faces that the file lists as triangles. Patches are those of the file that
   * have triangles; faces without a triangle are in "boundary" or "interface".
   */
  readonly mesh: Mesh;
  /** Per patch: shapes of its triangles, and their mean edge in model units as `meanEdge`. */
  readonly patchShapes: readonly PatchQuality[];
  /** The boundary faces and interfaces with the nodes that they use: a surface for `createBody`. */
  readonly outer: Pick<Mesh, "points" | "triangles" | "trianglePatch" | "patches">;
}

/**
 * Returns the mesh of a file together with its boundary, as a run returns its mesh. The triangles of the file name the
 * patches; those that are no face of a tetrahedron are left out. O(n). Rejects with a `MesherError` if the file has no
 * tetrahedra or its arrays are inconsistent.
 */
export async function meshWithBoundary(mesh: Mesh): Promise<MeshWithBoundary> {
  refuse(await inSteps(checkFileMesh(mesh)));
  if (mesh.tetrahedra.length === 0) {
    refuse([packageDiagnostic("no-tetrahedra", "the mesh has no tetrahedra", "Use a volume mesh.")]);
  }
  return inSteps(withBoundary(mesh));
}

function* withBoundary(mesh: Mesh): Steps<MeshWithBoundary> {
  const { tetrahedra, tetrahedronRegion: regions, trianglePatch } = mesh;
  const { twin, triangle } = yield* tetFaces(mesh);
  const faces: number[] = [];
  const owners: number[] = [];
  const isOuter: boolean[] = [];
  const [boundary, between] = [mesh.patches.length, mesh.patches.length + 1];
  yield* stepwise(twin.length, (face) => {
    const other = twin[face] ?? NONE;
    const isDivider = other === NONE || regions[face >>> 2] !== regions[other >>> 2];
    const given = triangle[face] ?? NONE;
    if ((other !== NONE && other < face) || (!isDivider && given === NONE)) return;
    faces.push(face);
    owners.push(given === NONE ? (other === NONE ? boundary : between) : (trianglePatch[given] ?? 0));
    isOuter.push(isDivider);
  });
  const added = ["boundary", "interface"].map((name, k) => ({ name, tag: mesh.patches.length + k + 1 }));
  const { patches, patchOf } = usedPatches([...mesh.patches, ...added], Uint32Array.from(owners));
  const triangles = new Uint32Array(3 * faces.length);
  const triangleRegions = new Uint32Array(2 * faces.length);
  yield* stepwise(faces.length, (t) => {
    const face = faces[t] ?? 0;
    const other = twin[face] ?? NONE;
    triangles.set(cornersOf(tetrahedra, face), 3 * t);
    triangleRegions[2 * t] = regions[face >>> 2] ?? 0;
    triangleRegions[2 * t + 1] = other === NONE ? NO_REGION : (regions[other >>> 2] ?? 0);
  });
  const outer = yield* boundaryOf({
    ...mesh,
    triangles: triangles.filter((_, i) => isOuter[Math.floor(i / 3)]),
  });
  const shown = { ...mesh, triangles, trianglePatch: patchOf, triangleRegions, patches };
  return {
    mesh: shown,
    patchShapes: yield* shapesByPatch(shown, patches.length),
    outer: {
      points: outer.points,
      triangles: outer.triangles,
      trianglePatch: patchOf.filter((_, t) => isOuter[t]),
      patches,
    },
  };
}

/** Returns the shapes of the triangles of each patch. */
function* shapesByPatch({ points, triangles, trianglePatch }: Mesh, count: number): Steps<PatchQuality[]> {
  const sums = Array.from({ length: count }, () => ({ triangles: 0, minAngle: 180, ratio: 0, edge: 0 }));
  yield* stepwise(trianglePatch.length, (t) => {
    const sum = sums[trianglePatch[t] ?? 0];
    if (!sum) return;
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
    const edges = [distance(points, a, b), distance(points, b, c), distance(points, c, a)] as const;
    const [p, q, r] = edges.toSorted((x, y) => x - y) as [number, number, number];
    const product = (p + q - r) * (q + r - p) * (r + p - q);
    // The smallest angle lies opposite the shortest edge.
    const cosine = Math.min(1, (q * q + r * r - p * p) / (2 * q * r));
    sum.triangles++;
    sum.minAngle = Math.min(sum.minAngle, (180 / Math.PI) * Math.acos(cosine));
    sum.ratio += product > 0 ? product / (p * q * r) : 0;
    sum.edge += (p + q + r) / 3;
  });
  return sums.map(({ triangles: all, minAngle, ratio, edge }, patch) => ({
    patch,
    triangles: all,
    minAngle,
    meanRadiusRatio: ratio / all,
    meanEdge: edge / all,
  }));
}

function distance(points: Float64Array, a: number, b: number): number {
  const along = (axis: number) => (points[3 * b + axis] ?? 0) - (points[3 * a + axis] ?? 0);
  return Math.hypot(along(0), along(1), along(2));
}

/** Returns the patches that own a triangle, and the new index of each triangle's patch. */
function usedPatches(patches: readonly MeshGroup[], owners: Uint32Array) {
  const used = [...usedGroups(owners, patches)];
  const indexOf = new Uint32Array(patches.length);
  used.forEach((patch, p) => (indexOf[patch] = p));
  return {
    patches: used.flatMap((patch) => patches[patch] ?? []),
    patchOf: owners.map((patch) => indexOf[patch] ?? 0),
  };
}

const extremes = v.object({ min: v.number(), max: v.number() });
const element = v.object({
  tetrahedron: v.number(),
  centroid: v.array(v.number()),
  dihedral: v.object({ min: v.number() }),
});
/** The parts of an inspection that a report needs. */
const inspected = v.object({
  nodes: v.number(),
  tetrahedra: v.number(),
  dihedral: extremes,
  radiusRatio: v.object({ min: v.number(), mean: v.number() }),
  volume: v.number(),
  edgeLengths: v.object({ mean: v.number() }),
  quality: v.object({
    binWidths: v.object({ dihedral: v.number() }),
    regions: v.array(v.object({ tetrahedra: v.number(), smallestDihedral: v.array(v.number()) })),
    shapes: v.object({ dihedral: v.object({ max: v.number() }) }),
    worst: v.array(element),
    limitedByBoundary: v.object({
      edges: v.number(),
      needles: v.number(),
      narrowGaps: v.number(),
      worst: v.array(element),
    }),
    poor: v.object({
      worst: v.nullable(element),
      reason: v.string(),
      value: v.number(),
      edge: v.object({ from: v.array(v.number()), to: v.array(v.number()) }),
      goodSize: v.number(),
      goodTetrahedra: v.number(),
    }),
  }),
});
const withTriangles = v.object({ mesh: v.object({ points: doubles(3), triangles: integers(3) }) });
const withRegions = v.object({
  points: doubles(3),
  tetrahedra: integers(4),
  tetrahedronRegion: integers(),
  regions: v.array(v.object({ name: v.string() })),
});
const withShapes = v.object({
  mesh: v.object({ ...withTriangles.entries.mesh.entries, ...withRegions.entries }),
  patchShapes: v.array(v.object({ meanEdge: v.number() })),
});
const withReport = v.object({
  ...withTriangles.entries,
  sides: integers(2),
  report: v.object({ diagnostics: v.array(v.object({ code: v.string() })) }),
});

/**
 * Returns a mesh from a file as the result of a run that took no time: with the statistics of `inspection`, which must be
 * of the same mesh. The mean edge is the unit of length. Throws a `MesherError` if an argument is invalid.
 */
export function inspectedResult(
  opened: Omit<MeshWithBoundary, "outer">,
  inspection: MeshInspection,
): MeshResult {
  checkArgument("opened", opened, withShapes);
  checkArgument("inspection", inspection, inspected);
  const { mesh, patchShapes } = opened;
  const meanEdge = inspection.edgeLengths.mean;
  const report: MeshReport = {
    ...emptyReport("done", poorElementWarnings(inspection.quality, true)),
    triangles: mesh.triangles.length / 3,
    regions: regionsOf(mesh, inspection.quality),
    patches: patchShapes.map((shape) => ({ ...shape, meanEdge: shape.meanEdge / meanEdge })),
    ...figuresOf(inspection),
  };
  return { ...emptyResult("done"), mesh, surfaceNodes: mesh.points.length / 3, report };
}

const improved = v.object({
  mesh: withRegions,
  nodeOrigin: integers(),
});

/**
 * Returns the result of a run with its improved elements: `improvement` is that of its mesh, and `inspection` that of the
 * improved elements. The mean edge is the unit of length; shapes are measured in space.
 *
 *     const improvement = await mesher.improveMesh(result.mesh);
 *     const better = improvedResult(result, improvement, await mesher.inspectMesh(improvement.mesh));
 *
 * Throws a `MesherError` if an argument is invalid.
 */
export function improvedResult(
  result: MeshResult,
  improvement: MeshImprovement,
  inspection: MeshInspection,
): MeshResult {
  checkArgument("result", result, withReport);
  checkArgument("improvement", improvement, improved);
  checkArgument("inspection", inspection, inspected);
  const { mesh, nodeOrigin } = improvement;
  const { metricShapes: _, recording: __, ...rest } = result;
  const { secondOrder: _s, ...report } = result.report;
  const diagnostics = report.diagnostics.filter(({ code }) => code !== "poor-elements");
  return {
    ...rest,
    mesh,
    front: new Uint32Array(),
    sides: renumbered(result.sides, nodeOrigin, result.mesh.points.length / 3),
    report: {
      ...report,
      ...figuresOf(inspection),
      regions: regionsOf(mesh, inspection.quality),
      fingerprint: "",
      diagnostics: [...diagnostics, ...poorElementWarnings(inspection.quality)],
    },
  };
}

function figuresOf({ nodes, tetrahedra, dihedral, radiusRatio, volume, quality }: MeshInspection) {
  return { nodes, tetrahedra, dihedral, radiusRatio, volume, quality } satisfies Partial<MeshReport>;
}
