/**
 * Converts the engine's results on given surfaces and meshes: describes the diagnostics, and turns rows of numbers
 * into records.
 */
import type { Steps } from "../base/steps.js";
import { describeAll, describeInSteps } from "../diagnostics/describe.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { type EntityNamer, nameByIndex } from "../diagnostics/entity-names.js";
import type {
  EngineInspection,
  EngineRefinement,
  EngineRepair,
  EngineVolumeInspection,
} from "../engine/loader.js";
import { qualityReport, rowsOf } from "../engine/quality-report.js";
import type {
  EdgeLengths,
  MeshInspection,
  Position,
  RepairChange,
  ShellInfo,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRepair,
  TriangleQuality,
} from "../mesh/inspection.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { needleWarnings } from "../mesh/quality-warnings.js";
import { originsOf } from "./surface-numbers.js";

const SHELL_STRIDE = 6;
const TRIANGLE_STRIDE = 7;

export function* describedInspection(
  found: EngineInspection,
  surface: SurfaceInput,
  name: EntityNamer,
): Steps<SurfaceInspection> {
  const warnings = found.isFillable ? yield* needleWarnings(surface) : [];
  const { regions, box, diagnostics, shells, worst, edgeLengths, ...rest } = found;
  const described = rowsOf(shells, SHELL_STRIDE).map(shellFigures);
  return {
    ...rest,
    regions,
    cavities: described.filter(({ isCavity }) => isCavity).length,
    box: rest.nodes === 0 ? null : { low: positionAt(box, 0), high: positionAt(box, 1) },
    edgeLengths: lengthsOf(edgeLengths),
    shells: described,
    worst: rowsOf(worst, TRIANGLE_STRIDE).map(triangleFigures),
    diagnostics: [...(yield* describeInSteps(diagnostics, name)), ...warnings],
  };
}

export function changeDiagnostics({
  diagnostics,
}: Pick<EngineRepair | EngineRefinement, "diagnostics">): Diagnostic[] {
  return describeAll(diagnostics, nameByIndex);
}

/** `given`: number of nodes of the surface before the repair. */
export function describedRepair(
  { points, triangles, origin, ...rest }: EngineRepair,
  given: number,
): SurfaceRepair {
  const { kinds, subjects, positions } = rest;
  const changes = Array.from(kinds, (kind, i) => ({
    ...CHANGES[kind]?.(subjects[2 * i] ?? 0, subjects[2 * i + 1] ?? 0),
    position: positionAt(positions, i),
  })) as RepairChange[];
  const gone = new Set(
    changes.flatMap((change) =>
      change.kind === "welded-node" || change.kind === "removed-node" ? [change.node] : [],
    ),
  );
  const nodeOrigin = originsOf(given, (node) => gone.has(node), 0);
  return { surface: { points, triangles, origin, nodeOrigin }, origin, changes };
}

export function describedRefinement(refinement: EngineRefinement): SurfaceRefinement {
  const { points, triangles, origin, splitEdges } = refinement;
  const nodeOrigin = originsOf(points.length / 3 - splitEdges, () => false, splitEdges);
  return { surface: { points, triangles, origin, nodeOrigin }, origin, splitEdges };
}

type WithoutPosition<T> = T extends unknown ? Omit<T, "position"> : never;

/** By the number of the engine's RepairKind. */
const CHANGES: readonly ((first: number, second: number) => WithoutPosition<RepairChange>)[] = [
  (node, into) => ({ kind: "welded-node", node, into }),
  (node) => ({ kind: "removed-node", node }),
  (triangle) => ({ kind: "removed-triangle", triangle }),
  (triangle, sameAs) => ({ kind: "removed-duplicate", triangle, sameAs }),
  (triangle, beyond) => ({ kind: "split-triangle", triangle, beyond }),
  (firstTriangle, triangles) => ({ kind: "filled-hole", firstTriangle, triangles }),
  (triangle) => ({ kind: "flipped-triangle", triangle }),
];

/** `inverted`: number of tetrahedra inverted in their file, in addition to those found. */
export function describedMesh(found: EngineVolumeInspection, inverted = 0): MeshInspection {
  const { quality, statistics, edgeLengths, boundary, boundaryRegion, ...rest } = found;
  const { isReadable: _, nodes, unusedNodes, tetrahedra, ...counts } = rest;
  const defects = { ...counts, invertedTetrahedra: counts.invertedTetrahedra + inverted };
  return {
    isValid: Object.values(defects).every((count) => count === 0),
    nodes,
    unusedNodes,
    tetrahedra,
    ...defects,
    edgeLengths: lengthsOf(edgeLengths),
    dihedral: { min: quality.minDihedral, max: quality.maxDihedral },
    radiusRatio: { min: quality.minRadiusRatio, mean: quality.meanRadiusRatio },
    volume: quality.volume,
    quality: qualityReport(statistics),
    boundary: { triangles: boundary, region: boundaryRegion },
  };
}

function shellFigures(row: readonly number[]): ShellInfo {
  const [firstTriangle = 0, triangles = 0, region = 0, isCavity = 0, area = 0, volume = 0] = row;
  return { firstTriangle, triangles, region, isCavity: isCavity === 1, area, volume };
}

function triangleFigures(row: readonly number[]): TriangleQuality {
  const [triangle = 0, x = 0, y = 0, z = 0, area = 0, smallestAngle = 0, radiusRatio = 0] = row;
  return { triangle, centroid: [x, y, z], area, smallestAngle, radiusRatio };
}

function lengthsOf([shortest = 0, mean = 0, longest = 0]: Float64Array): EdgeLengths {
  return { shortest, mean, longest };
}

function positionAt(flat: Float64Array, index: number): Position {
  return [flat[3 * index] ?? 0, flat[3 * index + 1] ?? 0, flat[3 * index + 2] ?? 0];
}
