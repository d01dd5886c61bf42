/** Converts the engine's results on given surfaces and meshes to those of the API. */
import type { Steps } from "../base/steps.js";
import { describeAll, describeInSteps } from "../diagnostics/describe.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { type EntityNamer, nameByIndex } from "../diagnostics/entity-names.js";
import type {
  EngineInspection,
  EnginePatchSplit,
  EngineRefinement,
  EngineRemesh,
  EngineRepair,
  EngineVolumeInspection,
} from "../engine/loader.js";
import { NO_ORIGIN, REPAIR_KINDS, type RepairKind } from "../generated/constants.js";
import { qualityReport } from "../engine/quality-report.js";
import type {
  MeshInspection,
  RepairChange,
  SharedVolume,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRemesh,
  SurfaceRepair,
} from "../mesh/inspection.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { needleWarnings } from "../mesh/quality-warnings.js";
import { carriedSurface } from "./carried-mesh.js";
import { nearNodeWarnings } from "./near-nodes.js";
import { resolutionWarnings } from "../mesh/resolution-warnings.js";
import { originsOf } from "./surface-numbers.js";

/** Type of the objects of type `Given` that have no fields but those of `Known`. */
type Only<Known, Given> = { readonly [Field in Exclude<keyof Given, keyof Known>]: never };

export function* describedInspection(
  found: EngineInspection,
  surface: SurfaceInput,
  name: EntityNamer,
): Steps<SurfaceInspection> {
  const coarse = yield* resolutionWarnings(surface);
  const warnings = [...(found.isFillable ? yield* needleWarnings(surface) : []), ...coarse];
  const near = found.openEdges > 0 ? yield* nearNodeWarnings(surface, name) : [];
  const { low, high, shortestEdge, meanEdge, longestEdge, diagnostics, ...rest } = found;
  return {
    ...(rest satisfies Only<SurfaceInspection, typeof rest>),
    cavities: rest.shells.filter(({ isCavity }) => isCavity).length,
    box: rest.nodes === 0 ? null : { low, high },
    edgeLengths: { shortest: shortestEdge, mean: meanEdge, longest: longestEdge },
    // Where nothing is left of the shape, this is the cause of everything else.
    diagnostics: coarse.some(({ severity }) => severity === "error")
      ? coarse
      : [...(yield* describeInSteps(diagnostics, name)), ...near, ...warnings],
  };
}

export function changeDiagnostics(
  { diagnostics }: Pick<EngineRepair | EngineRefinement | EngineRemesh | EnginePatchSplit, "diagnostics">,
  name: EntityNamer = nameByIndex,
): Diagnostic[] {
  return describeAll(diagnostics, name);
}

/** `given`: the surface before the repair; `diagnostics`: warnings about it. */
export function describedRepair(
  { points, triangles, origin, deviation, triangleRegions, ...rest }: EngineRepair,
  given: SurfaceInput,
  diagnostics: readonly Diagnostic[],
): SurfaceRepair {
  const { kind: kinds, first, second, position } = rest.changes;
  const changes = Array.from(kinds, (number, i): RepairChange[] => {
    const kind = REPAIR_KINDS[number];
    if (kind === undefined) return [];
    const [x = 0, y = 0, z = 0] = position.subarray(3 * i, 3 * i + 3);
    return [{ ...CHANGES[kind](first[i] ?? 0, second[i] ?? 0), position: [x, y, z] }];
  }).flat();
  const gone = new Set(
    changes.flatMap((change) =>
      change.kind === "welded-node" || change.kind === "removed-node" ? [change.node] : [],
    ),
  );
  const nodes = given.points.length / 3;
  const added = points.length / 3 - (nodes - gone.size);
  const nodeOrigin = originsOf(nodes, (node) => gone.has(node), added);
  return {
    mesh: carriedSurface(given, { points, triangles, origin, nodeOrigin, triangleRegions }),
    isSeparated: triangleRegions.length > 0,
    origin,
    changes,
    sharedVolumes: rest.sharedVolumes.map(sharedVolume),
    deviation,
    diagnostics,
  };
}

function sharedVolume(shared: EngineRepair["sharedVolumes"][number]): SharedVolume {
  const { first, second, position, ...rest } = shared;
  const [x, y, z] = position;
  return { regions: [first, second], ...rest, position: [x, y, z] };
}

/** `given`: the surface before the refinement. */
export function describedRefinement(refinement: EngineRefinement, given: SurfaceInput): SurfaceRefinement {
  const { points, triangles, origin, splitEdges, lengthRatio } = refinement;
  const nodeOrigin = originsOf(points.length / 3 - splitEdges, () => false, splitEdges);
  const mesh = carriedSurface(given, { points, triangles, origin, nodeOrigin });
  return { mesh, origin, splitEdges, lengthRatio };
}

/** `given`: the surface before the remeshing; `notes`: about it. */
export function describedRemesh(
  remesh: EngineRemesh,
  given: SurfaceInput,
  notes: readonly Diagnostic[],
): SurfaceRemesh {
  const { points, triangles, origin, failedFaces, diagnostics: _, ...figures } = remesh;
  const nodeOrigin = new Uint32Array(points.length / 3).fill(NO_ORIGIN);
  return {
    mesh: carriedSurface(given, { points, triangles, origin, nodeOrigin }),
    origin,
    ...(figures satisfies Only<SurfaceRemesh, typeof figures>),
    failedFaces: [...failedFaces],
    diagnostics: notes,
  };
}

/** Digits of lengths in messages. */
const DIGITS = 3;

/** Deviation / tolerance up to which nobody is warned, if the tolerance was given and if it was not. */
const GIVEN_EXCESS = 1 + 10 ** -DIGITS;
const AUTOMATIC_EXCESS = 1.5;

/** Returns a warning if the deviation exceeds the tolerance; `isGiven`: by the caller. */
export function deviationWarnings(
  { deviation, tolerance, mergedDetails }: Pick<SurfaceRemesh, "deviation" | "tolerance" | "mergedDetails">,
  isGiven: boolean,
): Diagnostic[] {
  // What the digits of the message do not show is not worth one.
  const isByDetails = mergedDetails.length > 0;
  if (deviation <= tolerance * (isGiven || isByDetails ? GIVEN_EXCESS : AUTOMATIC_EXCESS)) return [];
  const [found, asked] = [deviation, tolerance].map((length) => Number(length.toPrecision(DIGITS)));
  const cause = isByDetails ? ", because details were dropped" : "";
  const warning: DiagnosticOf<"deviation-above-tolerance"> = {
    code: "deviation-above-tolerance",
    severity: "warning",
    message: `The deviation from the given surface is at most ${found}, but the tolerance is ${asked}${cause}`,
    remedy: isByDetails
      ? "Drop smaller details only, or none."
      : "Use smaller triangles or a larger tolerance.",
    entities: [],
    data: { deviation, tolerance },
  };
  return [warning];
}

type WithoutPosition<T> = T extends unknown ? Omit<T, "position"> : never;

/** The change of each kind, from the two indices that the engine returns with it. */
const CHANGES: {
  readonly [Kind in RepairKind]: (
    first: number,
    second: number,
  ) => WithoutPosition<Extract<RepairChange, { readonly kind: Kind }>>;
} = {
  "welded-node": (node, into) => ({ kind: "welded-node", node, into }),
  "removed-node": (node) => ({ kind: "removed-node", node }),
  "removed-triangle": (triangle) => ({ kind: "removed-triangle", triangle }),
  "removed-duplicate": (triangle, sameAs) => ({ kind: "removed-duplicate", triangle, sameAs }),
  "split-triangle": (triangle, beyond) => ({ kind: "split-triangle", triangle, beyond }),
  "filled-hole": (firstTriangle, triangles) => ({ kind: "filled-hole", firstTriangle, triangles }),
  "flipped-triangle": (triangle) => ({ kind: "flipped-triangle", triangle }),
  "resolved-intersection": (triangle, parts) => ({ kind: "resolved-intersection", triangle, parts }),
  "removed-sheet": (triangle) => ({ kind: "removed-sheet", triangle }),
};

/** `inverted`: number of tetrahedra inverted in their file, in addition to those found. */
export function describedMesh(found: EngineVolumeInspection, inverted = 0): MeshInspection {
  const {
    isReadable: _,
    nodes,
    unusedNodes,
    tetrahedra,
    shortestEdge,
    meanEdge,
    longestEdge,
    quality,
    statistics,
    boundary,
    ...counts
  } = found;
  const defects = {
    invertedTetrahedra: counts.invertedTetrahedra + inverted,
    degenerateTetrahedra: counts.degenerateTetrahedra,
    duplicateTetrahedra: counts.duplicateTetrahedra,
    nonManifoldFaces: counts.nonManifoldFaces,
    overlappingFaces: counts.overlappingFaces,
    coincidentNodes: counts.coincidentNodes,
  } satisfies Record<keyof typeof counts, number>;
  return {
    isValid: Object.values(defects).every((count) => count === 0),
    nodes,
    unusedNodes,
    tetrahedra,
    ...defects,
    edgeLengths: { shortest: shortestEdge, mean: meanEdge, longest: longestEdge },
    dihedral: { min: quality.minDihedral, max: quality.maxDihedral },
    radiusRatio: { min: quality.minRadiusRatio, mean: quality.meanRadiusRatio },
    volume: quality.volume,
    quality: qualityReport(statistics),
    boundary: { triangles: boundary.triangles, region: boundary.trianglePatch },
  };
}
