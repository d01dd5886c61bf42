/**
 * From the surface of a file to its mesh: repairs the surface if that is asked for or needed, decides what becomes of its
 * triangles, and fills it. The command line and `meshFile` share this file.
 */
import { inSteps } from "../calls/yielder.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { MesherError, refuse } from "../diagnostics/mesher-error.js";
import type { RunControl } from "../engine/control.js";
import type { InnerShells } from "../generated/constants.js";
import type { MeshResult } from "../mesh/report.js";
import { triangleShapes } from "../mesh/triangle-shapes.js";
import { bestOf, hasWelded, meshedBest } from "./best-repair.js";
import { checkControl, checkSurface } from "./input-checks.js";
import { located } from "./located-surface.js";
import type { ChangedSurface, MeshedSurface } from "./meshed-surface.js";
import type { Mesher } from "./mesher-interface.js";
import type { MeshOptions, SurfaceMeshOptions } from "./option-types.js";
import { emptyResult } from "./report.js";
import {
  checkSurfaceMeshOptions,
  givenRemeshSetting,
  meshPart,
  remeshSettings,
  repairPart,
  splitPart,
} from "./surface-mesh-options.js";
import { type SurfaceMesher, withControl } from "./surface-mesher.js";
import type { SolidPart, TreatedPart } from "./solid-parts.js";
import { type WholeNumbers, withWholeNumbers } from "./whole-numbers.js";
import { hasSolids, withoutRegions } from "./stated-solids.js";
import { preparedSurface, withSmallRepair } from "./surface-preparation.js";
import { touchingPairs, touchingShells, withSolidsOfPatches, withTouchingSolids } from "./touching-solids.js";
import { type ElementShapes, helpedByOthers, isBetter } from "./poor-kept.js";
import {
  type ControlOf,
  hasSizes,
  type TreatedSurface,
  treatedSurface,
  type Treatment,
} from "./surface-treatment.js";
import { expectedThinNotes } from "./thin-bodies.js";
import { isVisiblyChanged } from "./visible-change.js";
import type { RepairChange } from "../mesh/inspection.js";
import type { Mesh, SurfaceInput } from "../mesh/mesh.js";
import { completeSurface } from "./carried-mesh.js";
import { inOneOrder, inOrder } from "./second-order-mesh.js";
import { hasNamedPatches } from "./generated-mesh.js";
import { withInterfacePatches } from "./interface-patches.js";
import { WholeProgress } from "./whole-progress.js";

/** Loaded when it is needed: most files have one solid, or state what is joined. */
const ofParts = () => import("./solid-parts.js");

/** A surface whose options are decided, ready for its treatment. */
export interface ReadySurface extends ChangedSurface {
  readonly treatment: Treatment;
  /** Solids of which the surface consists, if they are treated by themselves. */
  readonly parts?: readonly ReadyPart[] | undefined;
}

/** Solids that are ready by themselves. */
interface ReadyPart {
  readonly ready: ReadySurface;
  readonly numbers: WholeNumbers;
}

/** What is known of a surface beside its options. */
export interface SurfaceOrigin {
  /** Whether it was triangulated from shapes: then it is remeshed, and repaired if it cannot be filled. Default false. */
  readonly isCad?: boolean | undefined;
  /**
   * Whether triangles between two regions form patches of their own, "base / post": a repair cuts such interfaces out of the
   * faces of solids. Default false.
   */
  readonly hasInterfacePatches?: boolean | undefined;
}

/**
 * Returns the surface after the repair and the split of its patches that are asked for or implied, and what becomes of its
 * triangles. `isExact`: whether an implied repair welds no nodes. Rejects with `invalid-input`.
 */
export async function readySurface(
  mesher: SurfaceMesher,
  given: Mesh,
  options: SurfaceMeshOptions,
  origin: SurfaceOrigin,
  isExact = false,
): Promise<ReadySurface> {
  const { innerShells, surface: wanted = origin.isCad ? "remesh" : "auto" } = options;
  const asked = await decided(given, wanted, options);
  const mayBeDivided =
    (asked.kind === "smaller" || asked.kind === "remesh") &&
    repairPart(options) === undefined &&
    splitPart(options) === undefined &&
    given.patches.length > 1;
  const parts = mayBeDivided ? await (await ofParts()).solidParts(mesher, given) : undefined;
  const ready =
    parts === undefined
      ? await readyWhole(mesher, given, asked, options, origin, isExact)
      : await readyParts(mesher, parts, asked, options, origin, isExact);
  if ((ready.surface.surfaceRegions?.regions.length ?? 0) < 2) return ready;
  const { sharedFacesNote } = await import("./solids.js");
  // Regions that a file states say what inner shells bound.
  const surface = hasSolids(given) ? ready.surface : await withInnerShells(ready.surface, innerShells);
  return { ...ready, surface, diagnostics: [...ready.diagnostics, ...sharedFacesNote(surface)] };
}

/** As `readySurface`, for solids that are treated by themselves. */
async function readyParts(
  mesher: SurfaceMesher,
  parts: readonly SolidPart[],
  asked: Treatment,
  options: SurfaceMeshOptions,
  origin: SurfaceOrigin,
  isExact: boolean,
): Promise<ReadySurface> {
  const ready: ReadyPart[] = [];
  const { unitedReady } = await ofParts();
  for (const { surface, numbers } of parts) {
    const part = readyWhole(mesher, surface, asked, options, origin, isExact);
    ready.push({ ready: await withWholeNumbers(numbers, part), numbers });
  }
  const united = unitedReady(ready.map((part) => ({ ...part.ready, numbers: part.numbers })));
  return { ...united, treatment: asked, parts: ready };
}

/** Returns the surface of solids; those inside others bound cavities, if inner shells do. */
async function withInnerShells(surface: Mesh, innerShells: InnerShells | undefined): Promise<Mesh> {
  return innerShells === "cavities" ? (await import("./solids.js")).withCavities(surface) : surface;
}

/** As `readySurface`, for a surface of which all solids are treated alike. `asked`: what becomes of triangles that do not touch others. */
async function readyWhole(
  mesher: SurfaceMesher,
  given: Mesh,
  asked: Treatment,
  options: SurfaceMeshOptions,
  { isCad = false }: SurfaceOrigin,
  isExact: boolean,
): Promise<ReadySurface> {
  const { innerShells, surface: wanted = isCad ? "remesh" : "auto" } = options;
  const repair = repairPart(options);
  const stated = await withTouchingSolids(mesher, given, innerShells);
  const first = await decidedForSolids(mesher, stated, asked, options);
  const isRemeshed = first.kind === "remesh";
  const isRepairImplied = repair === undefined && (isRemeshed || isCad);
  const preparation = { repair, innerShells, isRepairImplied, isRemeshed, isExact };
  const isKept = repair === undefined && first.kind === "smaller";
  const small = isKept ? await withSmallRepair(mesher, stated, innerShells) : undefined;
  const prepared = small ?? (await preparedSurface(mesher, stated, preparation));
  const { surface: whole, changes, repairDeviation, warnings = [] } = prepared;
  const isUnasked = first.needles !== undefined || (first.touching !== undefined && !hasSolids(stated));
  if (isRepairImplied && isUnasked && isVisiblyChanged(stated, prepared)) {
    const { diagnostics } = await mesher.inspectSurface(stated, { innerShells });
    refuse(diagnostics.filter(({ severity, code }) => severity === "error" || code === "coarse-coordinates"));
  }
  const treatment = repair === undefined ? first : await decided(whole, wanted, options);
  const split = splitPart(options);
  const divided = split === undefined ? whole : (await mesher.splitPatches(whole, split)).mesh;
  const { surface, diagnostics } = await located(mesher, divided, innerShells);
  const damaged = isCad && repair === undefined ? await damageNotes(stated, changes) : [];
  return {
    surface,
    treatment,
    changes,
    repairDeviation,
    split: split && { before: whole.patches.length, after: divided.patches.length },
    diagnostics: [
      ...warnings,
      ...damaged,
      ...(repair === undefined ? await nearSolids(stated) : []),
      ...diagnostics,
    ],
  };
}

const damageNotes = async (given: Mesh, changes: readonly RepairChange[] | undefined) =>
  changes === undefined ? [] : inSteps((await import("./damaged-faces.js")).damagedFaces(given, changes));

/** Returns warnings about solids that are patches closed by themselves and almost touch; of stated solids, others warn. */
async function nearSolids(surface: Mesh): Promise<readonly Diagnostic[]> {
  if (hasSolids(surface) || surface.patches.length < 2) return [];
  const solids = await withSolidsOfPatches(surface);
  return solids === surface ? [] : (await import("./near-solids.js")).almostTouching(solids, []);
}

/** Returns the treatment; solids whose triangles do not fit together are remeshed too, which gives both the same face. */
async function decidedForSolids(
  mesher: SurfaceMesher,
  surface: Mesh,
  treatment: Treatment,
  options: SurfaceMeshOptions,
): Promise<Treatment> {
  const isAsked = treatment.kind !== "smaller" || repairPart(options) !== undefined;
  if (isAsked) return treatment;
  const touching = await countTouching(mesher, surface, options.innerShells);
  return touching > 0 ? { kind: "remesh", touching } : treatment;
}

/** Returns the number of pairs of solids that touch. If the surface states no solids, its closed shells count. */
async function countTouching(
  mesher: SurfaceMesher,
  surface: Mesh,
  innerShells: InnerShells | undefined,
): Promise<number> {
  if (!hasSolids(surface)) return touchingShells(mesher, surface, innerShells);
  const { diagnostics } = await mesher.inspectSurface(withoutRegions(surface), { innerShells });
  return touchingPairs(surface.surfaceRegions, diagnostics).length;
}

/** Decides what becomes of the triangles: needles, and those for which options of a remeshing are given, are replaced. */
async function decided(
  surface: Mesh,
  wanted: NonNullable<SurfaceMeshOptions["surface"]>,
  options: SurfaceMeshOptions,
): Promise<Treatment> {
  if (wanted !== "auto") return { kind: wanted };
  // Its triangles would limit the number of elements.
  if (options.elements !== undefined) return { kind: "remesh" };
  if (givenRemeshSetting(options) !== undefined) return { kind: "remesh" };
  const shapes = await inSteps(triangleShapes(surface));
  return shapes.isFit ? { kind: "smaller" } : { kind: "remesh", needles: shapes };
}

/** How a surface that is ready is meshed. */
export interface FillingOptions extends SurfaceOrigin {
  /** Options of the mesh and of a remeshing; the background grid has been read. */
  readonly options: SurfaceMeshOptions;
  readonly controlOf: ControlOf;
  /** Factor on the automatic sizes of a remeshing. Default 1. */
  readonly sizeFactor?: number | undefined;
  /** Called with what is worth to know of the surface before it is remeshed and before it is filled, which may take long. */
  readonly onTreated?: ((diagnostics: readonly Diagnostic[]) => void) | undefined;
  /** Whether the front is recorded, also one that stalls: then no second surface is tried. Default false. */
  readonly isRecorded?: boolean | undefined;
}

/** As `filledOnce`, with the number of elements and in the order that are asked for. */
export async function filledSurface(
  mesher: Mesher,
  given: Mesh,
  ready: ReadySurface,
  filling: FillingOptions,
): Promise<MeshedSurface> {
  const made = await filledLinear(mesher, given, ready, filling);
  try {
    return await inOrder(mesher, made, filling.options, filling.controlOf("curve"));
  } catch (failure) {
    return cancelled(failure, ready);
  }
}

/** As `filledOnce`, until the mesh has the number of elements, if that is asked for. */
async function filledLinear(
  mesher: Mesher,
  given: Mesh,
  ready: ReadySurface,
  filling: FillingOptions,
): Promise<MeshedSurface> {
  const { surface, treatment } = ready;
  const { elements } = filling.options;
  if (treatment.kind === "smaller" && isFree(filling)) return filledBetter(mesher, given, ready, filling);
  // The call that fills a kept surface reaches the number itself.
  if (elements === undefined || treatment.kind === "keep") return filledOnce(mesher, given, ready, filling);
  const parts = ready.parts?.map((part) => part.ready.surface) ?? [surface];
  const counted = { surface, parts, isRemeshed: treatment.kind === "remesh" };
  try {
    const { filledToElements } = await import("./counted-surface.js");
    return await filledToElements(mesher, counted, { ...filling, elements }, (scaled) =>
      filledOnce(mesher, given, ready, { ...filling, ...scaled }),
    );
  } catch (failure) {
    return cancelled(failure, ready);
  }
}

/** Returns whether triangles that are kept may be replaced: nobody asked for them, for a size or for the record of a front. */
const isFree = ({ options, isRecorded }: FillingOptions): boolean =>
  (options.surface ?? "auto") === "auto" && !hasSizes(options) && isRecorded !== true;

/** As `filledOnce`, for triangles that are kept. If elements beside them are poor, replaces them, and keeps the better mesh. */
async function filledBetter(
  mesher: Mesher,
  given: Mesh,
  ready: ReadySurface,
  filling: FillingOptions,
): Promise<MeshedSurface> {
  const { controlOf } = new WholeProgress(filling.controlOf("attempt"));
  return bestOf<MeshedSurface>(
    [
      () => filledOnce(mesher, given, ready, { ...filling, controlOf }),
      async (kept) => {
        const poor = kept && helpedByOthers(kept);
        if (poor === undefined) return undefined;
        const options = { ...filling.options, surface: "remesh" } as const;
        return filledOnce(mesher, given, withRemeshing(ready, poor), { ...filling, options });
      },
    ],
    (made, kept) => made.report.status === "cancelled" || isBetter(made, kept),
  );
}

/** Returns the surface, to be remeshed because elements beside its triangles are poor. */
const withRemeshing = ({ parts, ...one }: ReadySurface, poor: ElementShapes): ReadySurface => ({
  ...one,
  treatment: { kind: "remesh", poor },
  parts: parts?.map((part) => ({ ...part, ready: withRemeshing(part.ready, poor) })),
});

/**
 * Treats and fills a surface. If triangles and elements are poor after a repair that welded nodes and a remeshing, tries an exact
 * repair too, and keeps the better. Cancelled, the result has this status.
 */
async function filledOnce(
  mesher: Mesher,
  given: Mesh,
  ready: ReadySurface,
  filling: FillingOptions,
): Promise<MeshedSurface> {
  if (ready.parts !== undefined) return partsFilled(mesher, ready, ready.parts, filling);
  const { options, controlOf } = filling;
  const mesh = meshPart(options);
  const again = () =>
    readySurface(
      withControl(mesher, () => controlOf("check")),
      given,
      options,
      filling,
      true,
    );
  const isExactPossible = repairPart(options) === undefined && ready.treatment.kind === "remesh";
  const isRepeatable = isExactPossible && filling.isRecorded !== true;
  const exact = isRepeatable && hasWelded(given, ready) ? again : undefined;
  let attempt = filling;
  try {
    const filled = await meshedBest(
      ready,
      exact,
      (one) => {
        if (exact !== undefined)
          attempt = { ...filling, controlOf: new WholeProgress(controlOf("attempt")).controlOf };
        return treated(mesher, one, attempt);
      },
      (made) => {
        filling.onTreated?.(made.diagnostics ?? []);
        return fill(mesher, made, mesh, attempt.controlOf());
      },
    );
    const { made, prepared, result, isExact } = filled;
    const { treatment: _, ...done } = prepared;
    return meshed(result, done, made, { ...filling, isExact });
  } catch (failure) {
    return cancelled(failure, ready);
  }
}

/** As `filledOnce`, for solids that are treated by themselves and filled together. */
async function partsFilled(
  mesher: Mesher,
  { treatment: _, parts: __, ...ready }: ReadySurface,
  parts: readonly ReadyPart[],
  filling: FillingOptions,
): Promise<MeshedSurface> {
  const made: TreatedPart[] = [];
  const whole = new WholeProgress(filling.controlOf("remesh"));
  const trianglesFrom = (first: number): number =>
    parts.slice(first).reduce((sum, { ready: part }) => sum + part.surface.triangles.length, 0);
  const { unitedTreated, withNesting } = await ofParts();
  for (const [p, { ready: part, numbers }] of parts.entries()) {
    const { controlOf } = new WholeProgress(whole.next(part.surface.triangles.length / trianglesFrom(p)));
    const done = await withWholeNumbers(numbers, treated(mesher, part, { ...filling, controlOf }));
    made.push({ ...done, numbers });
  }
  const treatedParts = unitedTreated(made);
  // A solid of one part may lie within one of another.
  const united =
    treatedParts.invalid === undefined
      ? {
          ...treatedParts,
          surface: await withInnerShells(
            await withNesting(mesher, treatedParts.surface),
            filling.options.innerShells,
          ),
        }
      : treatedParts;
  filling.onTreated?.(united.diagnostics ?? []);
  const result = await fill(mesher, united, meshPart(filling.options), filling.controlOf());
  return meshed(result, ready, united, { ...filling, isExact: false });
}

async function treated(
  mesher: Mesher,
  { surface, treatment }: ReadySurface,
  { options, sizeFactor, controlOf, onTreated }: FillingOptions,
): Promise<TreatedSurface> {
  const remeshing = remeshSettings(options);
  // A remeshing to one layer of a thin body takes minutes.
  if (treatment.kind === "remesh" && onTreated !== undefined && options.elements === undefined)
    onTreated(await inSteps(expectedThinNotes(surface, { ...meshPart(options), ...remeshing })));
  const treating = { treatment, remeshing, options: meshPart(options), sizeFactor, controlOf };
  return treatedSurface(mesher, surface, treating);
}

/** Returns what a run that was cancelled has made; throws other failures. */
function cancelled(failure: unknown, ready: ReadySurface): MeshedSurface {
  if (!(failure instanceof MesherError) || failure.code !== "cancelled") throw failure;
  return { ...emptyResult("cancelled"), ...ready, isExact: false };
}

/** Returns the mesh of a surface, and what was done to the surface before. */
function meshed(
  result: MeshResult,
  ready: ChangedSurface,
  { invalid, diagnostics: _, ...treated }: TreatedSurface,
  {
    hasInterfacePatches,
    isExact,
  }: Pick<FillingOptions, "hasInterfacePatches"> & { readonly isExact: boolean },
): MeshedSurface {
  const all = { ...ready, ...(invalid === undefined && treated), isExact };
  return { ...(hasInterfacePatches === true ? withInterfaces(result, all.surface) : result), ...all };
}

/** Returns the result with patches for interfaces, if the surface states its regions. */
function withInterfaces(result: MeshResult, surface: Mesh): MeshResult {
  const isStated = surface.surfaceRegions !== undefined && hasNamedPatches(surface);
  return isStated ? { ...result, mesh: { ...result.mesh, ...withInterfacePatches(result.mesh) } } : result;
}

async function fill(
  mesher: Mesher,
  { surface, invalid, diagnostics = [] }: TreatedSurface,
  options: MeshOptions,
  control: RunControl,
): Promise<MeshResult> {
  if (invalid !== undefined) return emptyResult("invalid-input", invalid);
  const result = await mesher.fillSurface(surface, options, control);
  const { report } = result;
  // Those of the treatment came first.
  return { ...result, report: { ...report, diagnostics: [...diagnostics, ...report.diagnostics] } };
}

/** Returns the end of a run in which nothing became of the surface. */
export function unmeshed(result: MeshResult, surface = result.mesh): MeshedSurface {
  return { ...result, surface, diagnostics: [], isExact: false };
}

/** Implements `meshSurface` of the mesher. */
export async function meshedSurface(
  mesher: Mesher,
  surface: SurfaceInput,
  options: SurfaceMeshOptions,
  control: RunControl,
  origin: SurfaceOrigin = {},
): Promise<MeshedSurface> {
  refuse(checkControl(control));
  const wrong = [...checkSurface(surface), ...checkSurfaceMeshOptions(options)];
  if (wrong.length > 0) return unmeshed(emptyResult("invalid-input", wrong));
  const given = completeSurface(surface);
  const whole = new WholeProgress(inOneOrder(control, options));
  const found: Diagnostic[] = [];
  try {
    const checked = withControl(mesher, () => whole.controlOf("check"));
    const ready = await readySurface(checked, given, options, origin);
    found.push(...ready.diagnostics);
    const { controlOf } = whole;
    const made = await filledSurface(mesher, given, ready, { options, ...origin, controlOf });
    whole.end();
    const diagnostics = [...made.diagnostics, ...made.report.diagnostics];
    return { ...made, report: { ...made.report, diagnostics } };
  } catch (failure) {
    if (!(failure instanceof MesherError)) throw failure;
    if (failure.code === "cancelled") return unmeshed(emptyResult("cancelled", found), given);
    if (failure.code !== "invalid-input") throw failure;
    return unmeshed(emptyResult("invalid-input", [...failure.data.diagnostics, ...found]), given);
  }
}
