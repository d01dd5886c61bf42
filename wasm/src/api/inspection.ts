/**
 * Given surfaces and meshes before anything is done with them: what is there, what is wrong, and what
 * was repaired on request. The engine's answers, put into names.
 */
import { needleWarnings } from "../diagnostics/quality-warnings.js";
import { describeAll, describeInSteps } from "../diagnostics/sentences.js";
import type { Engine } from "../engine/loader.js";
import type { Steps } from "../formats/steps.js";
import { nameByPosition, type EntityNamer } from "../project/arrays.js";
import { qualityReport, rowsOf } from "../engine/quality-report.js";
import { originsOf } from "./surface-numbers.js";
import type { Diagnostic, InnerShells, QualityReport, SurfaceInput } from "./types.js";

/** In model units. */
export type Position = readonly [x: number, y: number, z: number];

/** Lengths of edges in model units. */
export interface EdgeLengths {
  readonly shortest: number;
  readonly mean: number;
  readonly longest: number;
}

/** One closed, connected part of a surface. A wall between bodies belongs to one on either side. */
export interface ShellInfo {
  readonly firstTriangle: number;
  readonly triangles: number;
  /** The body on its inner side, as in `VolumeMesh.regions`. */
  readonly region: number;
  /** Whether it bounds a void within that body. */
  readonly isCavity: boolean;
  /** In squared model units. */
  readonly area: number;
  /** Enclosed by this shell alone, in cubed model units, above 0. */
  readonly volume: number;
}

/** One triangle of a surface. */
export interface TriangleQuality {
  readonly triangle: number;
  /** Its centroid. */
  readonly centroid: Position;
  readonly area: number;
  /** Degrees. */
  readonly smallestAngle: number;
  /** 2 × inradius / circumradius, 1 for the equilateral triangle. */
  readonly radiusRatio: number;
}

/**
 * What `inspectSurface` finds. Where coordinates or indices are broken only `diagnostics` tells. Triangles with a node
 * twice make no edges, and of those with the same nodes only the first does.
 */
export interface SurfaceInspection {
  /** Whether `fillSurface` would accept the surface: no error is among the diagnostics. */
  readonly isFillable: boolean;
  /** No edge has one triangle only. */
  readonly isClosed: boolean;
  /** No edge has more than two triangles, and at every node they form one fan. */
  readonly isManifold: boolean;
  /** No two triangles meet but in common corners and edges. */
  readonly isEmbedded: boolean;
  /** That triangles use. */
  readonly nodes: number;
  readonly unusedNodes: number;
  readonly triangles: number;
  readonly edges: number;
  /** With one triangle. */
  readonly openEdges: number;
  /** With more than two. */
  readonly nonManifoldEdges: number;
  /** Where the surface touches itself in a point. */
  readonly nonManifoldNodes: number;
  /**
   * Triangles that do not face outward. Where a whole part of the surface is so, filling sets it right and says so;
   * single ones are errors. Known where nothing else keeps the surface from being filled.
   */
  readonly flippedTriangles: number;
  /** Known where `isFillable`. */
  readonly regions: number;
  /** Known where `isFillable`. */
  readonly cavities: number;
  /** Of all nodes in use; null without any. */
  readonly box: { readonly low: Position; readonly high: Position } | null;
  /** In squared model units. */
  readonly area: number;
  /** Of all bodies without their cavities, in cubed model units; known where `isFillable`. */
  readonly volume: number;
  readonly edgeLengths: EdgeLengths;
  /** By their first triangles; known where `isFillable`. */
  readonly shells: readonly ShellInfo[];
  /** Up to ten triangles, by radius ratio, the worst first. */
  readonly worst: readonly TriangleQuality[];
  /**
   * Everything that is wrong, as a run would tell it: of each code the first thousand, or as many as
   * `InspectionOptions.findings` asks for; the `count` of an error's data is of them all.
   */
  readonly diagnostics: readonly Diagnostic[];
}

/** What `repairSurface` may change. Without options nothing is moved or added. */
export interface RepairOptions {
  /**
   * Nodes no further apart than this become one, in model units. 0, the default, takes those at the very
   * same place, `false` none.
   */
  readonly weld?: number | false | undefined;
  /** Triangles without area, and all but one of those with the same nodes. Default true. */
  readonly removeTriangles?: boolean | undefined;
  /** Holes of up to so many edges are filled, at most 200. Default 0: none. */
  readonly fillHoles?: number | undefined;
  /** Triangles are turned to agree with each other, and outward where that is known. Default true. */
  readonly orient?: boolean | undefined;
  /** As a run is to take closed parts within others: cavities face the other way. Default "cavities". */
  readonly innerShells?: InnerShells | undefined;
}

/** One change. Numbers are positions in the given surface, but for the triangles of filled holes. */
export type RepairChange = { readonly position: Position } & (
  | { readonly kind: "welded-node"; readonly node: number; readonly into: number }
  | { readonly kind: "removed-node"; readonly node: number }
  | { readonly kind: "removed-triangle"; readonly triangle: number }
  | { readonly kind: "removed-duplicate"; readonly triangle: number; readonly sameAs: number }
  /** It had its corners on one line; the triangle beyond was split where the middle one lies. */
  | { readonly kind: "split-triangle"; readonly triangle: number; readonly beyond: number }
  /** Positions in the result. */
  | { readonly kind: "filled-hole"; readonly firstTriangle: number; readonly triangles: number }
  | { readonly kind: "flipped-triangle"; readonly triangle: number }
);

/** A surface after its repair, which is to be inspected: nothing is promised about it. */
export interface SurfaceRepair {
  readonly surface: SurfaceInput;
  /** Per triangle: its position in the given surface; `NO_ORIGIN` for one that fills a hole. */
  readonly origin: Uint32Array;
  /** Every one. */
  readonly changes: readonly RepairChange[];
}

/** A surface whose large triangles are divided: the same shape. */
export interface SurfaceRefinement {
  /** The given points, then the middles of the edges that were halved. */
  readonly surface: SurfaceInput;
  /** Per triangle: the position of the given triangle that it is a part of. */
  readonly origin: Uint32Array;
  /** How many edges were halved, halves of halves counted too; as many points are new. */
  readonly splitEdges: number;
}

/** What `inspectMesh` finds. */
export interface MeshInspection {
  /** None of the counts of defects below is above 0. */
  readonly isValid: boolean;
  /** That elements use. */
  readonly nodes: number;
  readonly unusedNodes: number;
  readonly tetrahedra: number;
  /** With a negative volume, or inverted in their file; measured as if two of their nodes were exchanged. */
  readonly invertedTetrahedra: number;
  /** Without volume, exactly. */
  readonly degenerateTetrahedra: number;
  /** With the nodes of another. */
  readonly duplicateTetrahedra: number;
  /** Of more than two elements. */
  readonly nonManifoldFaces: number;
  /** Faces whose two elements lie on the same side. */
  readonly overlappingFaces: number;
  /** Nodes at the place of another. */
  readonly coincidentNodes: number;
  /** Over all elements: an edge counts once for each of its elements. */
  readonly edgeLengths: EdgeLengths;
  /** Degrees. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius, 1 for the regular tetrahedron. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  /** In cubed model units. */
  readonly volume: number;
  /** The mean of `edgeLengths` is the wanted length. */
  readonly quality: QualityReport;
  /** Faces of one element: three nodes each, counter-clockwise seen from outside, and a region each. */
  readonly boundary: { readonly triangles: Uint32Array; readonly region: Uint32Array };
}

type ResultOf<Tool extends keyof Engine> = Engine[Tool] extends (...given: never[]) => infer Made
  ? NonNullable<Made> extends { result(): infer Result }
    ? Result
    : never
  : never;
/** The engine's answers, which cross to the caller as they are. */
export type EngineInspection = ResultOf<"inspectSurface">;
export type EngineRepair = ResultOf<"repairSurface">;
export type EngineRefinement = ResultOf<"refineSurface">;
export type EngineVolumeInspection = ResultOf<"inspectMesh">;

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
  return describeAll(diagnostics, nameByPosition);
}

/** `given`: how many nodes the surface had that was repaired. */
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

/** By the engine's RepairKind. */
const CHANGES: readonly ((first: number, second: number) => WithoutPosition<RepairChange>)[] = [
  (node, into) => ({ kind: "welded-node", node, into }),
  (node) => ({ kind: "removed-node", node }),
  (triangle) => ({ kind: "removed-triangle", triangle }),
  (triangle, sameAs) => ({ kind: "removed-duplicate", triangle, sameAs }),
  (triangle, beyond) => ({ kind: "split-triangle", triangle, beyond }),
  (firstTriangle, triangles) => ({ kind: "filled-hole", firstTriangle, triangles }),
  (triangle) => ({ kind: "flipped-triangle", triangle }),
];

/** `inverted`: so many that were turned before. */
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
