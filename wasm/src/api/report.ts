/**
 * Assembles results: statistics of the engine, and diagnostics with their sentences. Also makes results without a
 * mesh.
 */
import { describeAll } from "../diagnostics/describe.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { EntityNamer } from "../diagnostics/entity-names.js";
import { packageDiagnostic, sentence } from "../diagnostics/package-diagnostic.js";
import { regionCounts } from "../diagnostics/sentences.js";
import type { EnginePreview } from "../engine/loader.js";
import type { EngineResult } from "../engine/protocol.js";
import type { RegionStatistics } from "../engine/region-statistics.js";
import { NO_QUALITY, withRegions } from "../engine/quality-report.js";
import { poorElementWarnings } from "../mesh/quality-warnings.js";
import type { ElementBlocks } from "../mesh/element-blocks.js";
import type { Mesh } from "../mesh/mesh.js";
import type { MeshReport, MeshResult, MeshStatus, RegionSummary } from "../mesh/report.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { PatchQuality, QualityReport } from "../mesh/quality.js";
import type { Project } from "../project/project-types.js";
import type { ProjectPreview } from "../project/preview.js";
import { noVolume } from "../formats/boundary.js";
import { namedMesh, type NameSource } from "./generated-mesh.js";

/** Returns the engine's result; its mesh and its diagnostics use the names given by the user. */
export function describedResult(
  result: EngineResult,
  names: NameSource,
  name: EntityNamer,
  blocksOf: (indices: readonly number[]) => ElementBlocks | undefined,
): MeshResult {
  const { status, surface, volume, metricShapes, statistics, regionStatistics } = result;
  const { hasFoundNothingBetter, recording } = result;
  const { mesh, indices } = namedMesh(result, names, regionStatistics.length);
  const quality = withRegions(statistics.quality, indices);
  const blocks = blocksOf(indices);
  return {
    mesh,
    ...(blocks && { blocks }),
    surfaceNodes: surface.points.length / 3,
    front: volume.front,
    sides: surface.sides,
    sideLine: surface.sideLine,
    ...(metricShapes && { metricShapes }),
    ...(recording && { recording }),
    report: {
      status,
      ...statistics,
      regions: namedRegions(mesh, regionStatistics, indices),
      quality,
      diagnostics: [
        ...describeAll(result.diagnostics, name).map((found) => withNamedRegions(found, indices)),
        ...poorElementWarnings(quality),
        ...(hasFoundNothingBetter ? [nothingBetter()] : []),
      ],
    },
  };
}

/** Returns the regions of a mesh, in their order. `indices`: per region of the run its region; several may be one. */
function namedRegions(
  { regions }: Mesh,
  statistics: readonly RegionStatistics[],
  indices: readonly number[],
): RegionSummary[] {
  const summaries = regions.map(({ name }) => ({ name, tetrahedra: 0, volume: 0 }));
  statistics.forEach(({ tetrahedra, volume }, r) => {
    const summary = summaries[indices[r] ?? r];
    if (summary === undefined) return;
    summary.tetrahedra += tetrahedra;
    summary.volume += volume;
  });
  return summaries;
}

/** Returns the regions of a mesh that was measured. */
export function regionsOf({ regions }: Mesh, quality: Pick<QualityReport, "regions">): RegionSummary[] {
  const measured = new Map(quality.regions.map((one) => [one.region, one]));
  return regions.map(({ name }, r) => {
    const { tetrahedra = 0, volume = 0 } = measured.get(r) ?? {};
    return { name, tetrahedra, volume };
  });
}

function nothingBetter(): Diagnostic {
  const message =
    "thorough optimization found no mesh that is better in one measure and worse in none, so the mesh is that of the default optimization";
  return packageDiagnostic("no-improvement", message, "", "information");
}

export function describedPreview(preview: EnginePreview, name: EntityNamer): ProjectPreview {
  return { ...preview, diagnostics: describeAll(preview.diagnostics, name) };
}

/** Adds the deviation of the patches of bodies from their given surfaces. A body that was kept or refined has none. */
export function withBodyDeviations(
  result: MeshResult,
  { patches: drawn, bodies = [] }: Project,
  prepared: readonly PreparedBody[],
): MeshResult {
  const deviations = new Map<number, number | undefined>();
  let first = drawn.length;
  for (const body of bodies) {
    const made = prepared.find((one) => one.body === body.id);
    const isExact = body.surface === "keep" || body.surface === "refine";
    const largest = deviationByPatch(made, body.patches.length);
    body.patches.forEach((_, p) => deviations.set(first + p, isExact ? 0 : largest?.[p]));
    first += body.patches.length;
  }
  const patches = result.report.patches.map((quality): PatchQuality => {
    if (!deviations.has(quality.patch)) return quality;
    const { chordDeviation: _, ...rest } = quality;
    const deviation = deviations.get(quality.patch);
    return deviation === undefined ? rest : { ...rest, chordDeviation: deviation };
  });
  return { ...result, report: { ...result.report, patches } };
}

function deviationByPatch(made: PreparedBody | undefined, patches: number): Float64Array | undefined {
  if (made?.triangleDeviation === undefined) return undefined;
  const largest = new Float64Array(patches);
  made.triangleDeviation.forEach((deviation, t) => {
    const patch = made.trianglePatch[t] ?? 0;
    if (deviation > (largest[patch] ?? 0)) largest[patch] = deviation;
  });
  return largest;
}

/** Leaves out notes about the orientation of bodies, which their preparation has made. */
export function withoutBodyNotes(found: readonly Diagnostic[], { patches }: Project): Diagnostic[] {
  const drawn = new Set(patches.map(({ id }) => id));
  return found.filter(
    ({ code, entities }) => code !== "reoriented-patch" || entities.some(({ id }) => drawn.has(id ?? 0)),
  );
}

/** Adds the preparation of bodies to the result of a run: its time and its diagnostics. */
export function withPreparation(
  result: MeshResult,
  preparation: number,
  diagnostics: readonly Diagnostic[],
): MeshResult {
  const { seconds } = result.report;
  return {
    ...result,
    report: {
      ...result.report,
      seconds: {
        ...seconds,
        total: seconds.total + preparation,
        surface: seconds.surface + preparation,
      },
      diagnostics: [...diagnostics, ...result.report.diagnostics],
    },
  };
}

/**
 * Returns a note on the number of regions that counts solids in several parts once, as the list of regions does. `indices`: per
 * part that has elements, the index of its region; a run that ended early may lack some, and keeps the number of parts.
 */
function withNamedRegions(found: Diagnostic, indices: readonly number[]): Diagnostic {
  if (found.code !== "nested-regions" || found.data.regions !== indices.length) return found;
  const data = { ...found.data, regions: new Set(indices).size };
  return { ...found, message: sentence(regionCounts(data, indices.length)), data };
}

/** Returns a result without a mesh, for a run that was rejected, or cancelled before it made any element. */
export function emptyResult(
  status: MeshStatus,
  diagnostics: readonly Diagnostic[] = [],
  seconds = 0,
): MeshResult {
  return {
    mesh: {
      points: new Float64Array(),
      triangles: new Uint32Array(),
      trianglePatch: new Uint32Array(),
      patches: [],
      triangleRegions: new Uint32Array(),
      ...noVolume(),
    },
    surfaceNodes: 0,
    front: new Uint32Array(),
    sides: new Uint32Array(),
    sideLine: new Uint32Array(),
    report: emptyReport(status, diagnostics, seconds),
  };
}

export function emptyReport(status: MeshStatus, diagnostics: readonly Diagnostic[], seconds = 0): MeshReport {
  return {
    status,
    nodes: 0,
    tetrahedra: 0,
    triangles: 0,
    seconds: { total: seconds, check: 0, sides: 0, surface: 0, volume: 0, optimize: 0 },
    dihedral: { min: 0, max: 0 },
    radiusRatio: { min: 0, mean: 0 },
    volume: 0,
    regions: [],
    quality: NO_QUALITY,
    patches: [],
    recovery: { relaxed: 0, starred: 0, remeshed: 0, filled: 0, steinerPoints: 0 },
    interior: { lattice: 0 },
    threads: 1,
    front: {
      pops: 0,
      gatheredFaces: 0,
      candidatesTried: 0,
      facesTested: 0,
      facesAnalysed: 0,
      exactPredicates: 0,
    },
    fingerprint: "",
    diagnostics,
  };
}
