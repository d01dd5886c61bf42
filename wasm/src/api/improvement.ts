/** Describes the improvement of a mesh. */
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { describeAll } from "../diagnostics/describe.js";
import { nameByIndex } from "../diagnostics/entity-names.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { EngineImprovement } from "../engine/loader.js";
import { IMPROVE_DEFAULTS, NO_ORIGIN } from "../generated/constants.js";
import type { Mesh, VolumeInput } from "../mesh/mesh.js";
import { countOf, numbered } from "../formats/groups.js";
import { patchesIn } from "./carried-mesh.js";
import type { MeshImprovement, MeshShapes } from "../mesh/improvement.js";

export function improvementErrors({ diagnostics }: EngineImprovement): Diagnostic[] {
  return describeAll(diagnostics, nameByIndex);
}

/** `given`: the mesh before the improvement. */
export function describedImprovement(found: EngineImprovement, given: VolumeInput): MeshImprovement {
  const { isReadable: _, points: _p, tetrahedra: _t, regions: _r, before, after, ...rest } = found;
  return {
    ...rest,
    mesh: carriedVolume(given, found),
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

/** Elements that were improved. */
interface ImprovedElements extends Pick<Mesh, "points" | "tetrahedra" | "nodeOrigin"> {
  /** Per tetrahedron: its region, with the given numbers. */
  readonly regions: Uint32Array;
  readonly nodeOrigin: Uint32Array;
}

/** Returns improved elements with the triangles, patches and regions of the given mesh, whose nodes were kept. */
export function carriedVolume(given: VolumeInput, improved: ImprovedElements): Mesh {
  const { points, tetrahedra, regions: tetrahedronRegion, nodeOrigin } = improved;
  const { triangles = new Uint32Array(), regions = [] } = given;
  const {
    reversedTetrahedra: _r,
    invertedTetrahedra: _i,
    duplicateTetrahedra: _d,
    curvedEdges: _c,
    trueEdges,
    ...rest
  } = given;
  return {
    ...rest,
    points,
    triangles: renumbered(triangles, nodeOrigin, given.points.length / 3),
    ...(trueEdges && {
      trueEdges: { ...trueEdges, edges: renumbered(trueEdges.edges, nodeOrigin, given.points.length / 3) },
    }),
    ...patchesIn({ ...given, triangles }),
    tetrahedra,
    tetrahedronRegion,
    regions: regions.length > 0 ? regions : numbered("region", countOf(tetrahedronRegion)),
    nodeData: new Map(),
    elementData: undefined,
  };
}

/** Returns node indices after a change that kept these nodes. `count`: number of nodes before. */
export function renumbered(nodes: Uint32Array, nodeOrigin: Uint32Array, count: number): Uint32Array {
  const indexOf = new Uint32Array(count).fill(NO_ORIGIN);
  nodeOrigin.forEach((origin, node) => {
    if (origin !== NO_ORIGIN) indexOf[origin] = node;
  });
  return nodes.map((node) => indexOf[node] ?? NO_ORIGIN);
}
