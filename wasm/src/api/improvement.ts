/** Describes the improvement of a mesh, and transfers the patches, regions and names of a file to its result. */
import * as v from "valibot";
import { plural } from "../base/plural.js";
import { checkArgument } from "../calls/argument-checks.js";
import { doubles, integers } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { describeAll } from "../diagnostics/describe.js";
import { nameByIndex } from "../diagnostics/entity-names.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { EngineImprovement } from "../engine/loader.js";
import { IMPROVE_DEFAULTS, NO_ORIGIN } from "../generated/constants.js";
import type { FileMesh } from "../mesh/file-mesh.js";
import type { MeshImprovement, MeshShapes } from "../mesh/improvement.js";

export function improvementErrors({ diagnostics }: EngineImprovement): Diagnostic[] {
  return describeAll(diagnostics, nameByIndex);
}

export function describedImprovement(found: EngineImprovement): MeshImprovement {
  const { isReadable: _, before, after, ...rest } = found;
  return {
    ...rest,
    before: shapesOf(before),
    after: shapesOf(after),
    diagnostics: [
      ...invertedNotes(found.orientedTetrahedra),
      ...(found.isImproved ? [] : [NOTHING_BETTER]),
      ...growthNotes(found),
    ],
  };
}

function shapesOf({ quality, ...counts }: EngineImprovement["before"]): MeshShapes {
  return {
    ...counts,
    dihedral: { min: quality.minDihedral, max: quality.maxDihedral },
    radiusRatio: { min: quality.minRadiusRatio, mean: quality.meanRadiusRatio },
    volume: quality.volume,
  };
}

function invertedNotes(count: number): Diagnostic[] {
  if (count === 0) return [];
  const were = count === 1 ? "was" : "were";
  const message = `${plural(count, "tetrahedron")} with negative volume ${were} inverted; two nodes of each were exchanged`;
  return [packageDiagnostic("inverted-tetrahedra", message, "", "information")];
}

/** Says that more elements could help, if elements are poor that the boundary does not limit. */
function growthNotes({ isGrowthLimited, after }: EngineImprovement): Diagnostic[] {
  const poor = after.outOfRange - after.limitedByBoundary;
  if (!isGrowthLimited || poor === 0) return [];
  const have = poor === 1 ? "has" : "have";
  const message = `${plural(poor, "tetrahedron")} still ${have} angles outside 30° to 135°; more elements might help`;
  const remedy = `Permit more than ${100 * IMPROVE_DEFAULTS.maxGrowth} % with the option maxGrowth.`;
  return [packageDiagnostic("growth-limited", message, remedy, "information")];
}

const NOTHING_BETTER = packageDiagnostic(
  "no-improvement",
  "no better mesh was found; the elements are the given ones",
  "",
  "information",
);

const givenMesh = v.object({ points: doubles(3), triangles: integers(3), trianglePatch: integers() });
const improvedElements = v.object({
  points: doubles(3),
  tetrahedra: integers(4),
  regions: integers(),
  nodeOrigin: integers(),
});

/**
 * Returns an improved mesh with the triangles, patches and regions of the given file, ready to be written. Values at the
 * nodes are dropped, because nodes have moved, unless no better mesh was found. Throws a `MesherError` if an argument is
 * not such a mesh, or the triangles were not passed to `improveMesh`.
 *
 *     const improvement = await mesher.improveMesh({ ...file, regions: file.tetrahedronRegion });
 *     await writeMesh(improvedMesh(file, improvement), "better.vtu");
 */
export function improvedMesh(
  given: FileMesh,
  improvement: Pick<MeshImprovement, "isImproved" | "points" | "tetrahedra" | "regions" | "nodeOrigin">,
): FileMesh {
  checkArgument("given", given, givenMesh);
  checkArgument("improvement", improvement, improvedElements);
  const { points, tetrahedra, regions, nodeOrigin } = improvement;
  const indexOf = new Uint32Array(given.points.length / 3).fill(NO_ORIGIN);
  nodeOrigin.forEach((origin, node) => {
    if (origin !== NO_ORIGIN) indexOf[origin] = node;
  });
  const triangles = given.triangles.map((node) => indexOf[node] ?? NO_ORIGIN);
  const isKept = v.check(
    (nodes: Uint32Array) => !nodes.includes(NO_ORIGIN),
    "it has a triangle with a node that was not kept; pass the triangles to improveMesh",
  );
  checkArgument("given.triangles", triangles, v.pipe(integers(3), isKept));
  const { reversedTetrahedra: _r, invertedTetrahedra: _i, duplicateTetrahedra: _d, ...rest } = given;
  return {
    ...rest,
    points,
    triangles,
    tetrahedra,
    tetrahedronRegion: regions,
    nodeData: new Map(),
  };
}
