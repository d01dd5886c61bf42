/** Implements the mesher: checks arguments, sends them to the engine, and describes its answers. */
import { throwIfCancelled, untilCancelled } from "../calls/cancelling.js";
import type { AbortControl, PartialControl, RunControl } from "../engine/control.js";
import { type EntityNamer, gridByIndex } from "../diagnostics/entity-names.js";
import { MesherError, refuse } from "../diagnostics/mesher-error.js";
import { EngineClient, type RunRequest } from "../engine/engine-client.js";
import type { EngineResult } from "../engine/protocol.js";
import type { BodySurfaceArrays } from "../generated/constants.js";
import type {
  MeshInspection,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRemesh,
  SurfaceRepair,
} from "../mesh/inspection.js";
import type { MeshImprovement } from "../mesh/improvement.js";
import type { SurfaceInput, VolumeInput } from "../mesh/mesh.js";
import { inSteps } from "../calls/yielder.js";
import { resolutionWarnings } from "../mesh/resolution-warnings.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { MeshResult } from "../mesh/report.js";
import { modelWithBodyBoxes } from "../project/arrays.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import {
  backgroundFrom,
  backgroundOf,
  emptyGrid,
  projectBackground,
  projectSources,
  withNodes,
} from "../project/grid-arrays.js";
import { projectNamer, withMissingId, withPatchOfTriangle } from "../project/names.js";
import type { ProjectPreview } from "../project/preview.js";
import type { BodyId, Project, ProjectBackground } from "../project/project-types.js";
import {
  automaticBodies,
  type BodyOptions,
  bodyProblems,
  bodyWithId,
  joinedBodies,
  afterBodies,
  hasBodies,
  preparedBodies,
  preparedBody,
} from "./body-preparation.js";
import { unlessFailed } from "./best-repair.js";
import { beginCall } from "./call-checks.js";
import type { FinerPart } from "./element-count.js";
import {
  checkControl,
  checkImproveInput,
  checkLocatedSurface,
  withInnerShells,
  checkMesh,
  checkProject,
  checkVolume,
  drawnArrays,
  nothingToCover,
  unreadableMesh,
} from "./input-checks.js";
import { describedMesh } from "./inspection.js";
import { describedImprovement, improvementErrors } from "./improvement.js";
import { sizesAtNodes } from "./node-sizes.js";
import type {
  Mesher,
  PatchSplit,
  ProjectCheck,
  SizeProposal,
  SizeSamples,
  SurfaceSizeProposal,
} from "./mesher-interface.js";
import { checkedRun, drawnRun, refused, settledRun } from "./project-run.js";
import { type RegionLocation, locateRegions } from "./region-location.js";
import {
  ballOf,
  largestSize,
  longestEdge,
  pointsOf,
  scaledKeptOptions,
  scaledMeshOptions,
  scaledProject,
  withBall,
} from "./scaled-sizes.js";
import { sampleSizes } from "./size-samples.js";
import { proposeSurfaceSizes } from "./surface-sizes.js";
import type {
  CoverOptions,
  ImproveOptions,
  InspectionOptions,
  MeshOptions,
  PreviewOptions,
  ProjectMeshOptions,
  ProposalOptions,
  RefineOptions,
  RemeshOptions,
  RepairOptions,
  SplitOptions,
  SurfaceMeshOptions,
  SurfaceProposalOptions,
} from "./option-types.js";
import {
  checkCoverOptions,
  checkGridOptions,
  checkImproveOptions,
  checkOptions,
  checkPreviewOptions,
  checkProposalOptions,
  engineCoverOptions,
  engineOptions,
  engineProposalOptions,
  engineImproveOptions,
  withSettings,
} from "./options.js";
import {
  describedPreview,
  describedResult,
  emptyResult,
  withBodyDeviations,
  withoutBodyNotes,
  withPreparation,
} from "./report.js";
import { givenRegionsOf, surfaceNamer } from "./surface-numbers.js";
import { meshedSurface, unmeshed } from "./surface-meshing.js";
import { SurfaceTools } from "./surface-tools.js";
import { namedMesh, type NameSource } from "./generated-mesh.js";

/**
 * Starts a worker with an engine in it; resolves when it is loaded. Call `dispose` when done; in Node, an idle
 * mesher does not keep the process alive. Rejects with a `MesherError` of code `engine-not-loaded`, or `cancelled`
 * if the signal is aborted before; no worker is then left.
 *
 *     const mesher = await createMesher();
 *     const { mesh, report } = await mesher.fillSurface({ points, triangles }, { size: 0.1 });
 */
export async function createMesher(control: AbortControl = {}): Promise<Mesher> {
  refuse(checkControl(control));
  const { signal } = control;
  throwIfCancelled(signal);
  const mesher = new WorkerMesher();
  try {
    await untilCancelled(() => mesher.ready, signal);
    return mesher;
  } catch (failure) {
    mesher.dispose();
    throw failure;
  }
}

/** A mesh, and the bodies that were prepared for it. */
interface ElementsMade extends MeshResult {
  readonly bodies: readonly PreparedBody[];
}

/** Loaded when a number of elements is asked for. */
const ofElements = () => import("./counted-surface.js");

class WorkerMesher implements Mesher {
  readonly #client = new EngineClient();
  readonly #surfaces = new SurfaceTools(this.#client);
  readonly ready = this.#client.ready;

  async meshProject(project: Project, options: ProjectMeshOptions = {}, control: RunControl = {}) {
    const early = this.#endedEarly(control);
    if (early !== undefined) return early;
    const { settled, known, elements, errors } = settledRun(project, options);
    if (errors.length > 0) return emptyResult("invalid-input", errors);
    return elements === undefined
      ? this.#meshSettled(project, settled, known, control)
      : this.#meshToElements(project, settled, { elements, known }, control);
  }

  async checkProject(
    project: Project,
    options: ProjectMeshOptions = {},
    control: RunControl = {},
  ): Promise<ProjectCheck> {
    beginCall(this.#client, control);
    const { settled, known, errors } = settledRun(project, options);
    if (errors.length > 0) return refused(errors);
    if (!hasBodies(project)) return checkedRun(this.#client, { project, options: settled }, control);
    const drawn = await this.#errorsBefore(project, settled, control.signal);
    if (drawn.length > 0) return refused(drawn);
    const { bodies, diagnostics } = await preparedBodies(this.#surfaces, project, settled, known, control);
    if (bodies.length < (project.bodies?.length ?? 0)) return refused(diagnostics);
    return checkedRun(
      this.#client,
      { project, options: settled, bodies: joinedBodies(project, bodies) },
      control,
    );
  }

  /** Meshes a valid project with valid options, which include the project's settings. */
  #meshSettled(
    project: Project,
    options: BodyOptions,
    known: readonly PreparedBody[],
    control: RunControl,
  ): Promise<MeshResult> {
    if (hasBodies(project)) return this.#meshWithBodies(project, options, known, control);
    const { sizeFactor: _, ...own } = options;
    return this.#meshModel(project, own, control);
  }

  /** As `#meshSettled`, until the mesh has the number of elements. Known bodies and a recording have the final sizes only. */
  async #meshToElements(
    project: Project,
    options: MeshOptions,
    { elements, known }: { readonly elements: number; readonly known: readonly PreparedBody[] },
    control: RunControl,
  ): Promise<MeshResult> {
    const { elementsReached, expectedElements, largestAutomaticSize } = await ofElements();
    const points = pointsOf(project);
    const size = options.size ?? largestSize(project, options);
    const automatic =
      size === undefined && hasBodies(project) ? automaticBodies(project, options) : undefined;
    const sizeOf = async (factor: number): Promise<number | undefined> =>
      automatic ? largestAutomaticSize(this, automatic, factor) : size && size * factor;
    // With a number of elements, triangles to be refined are replaced.
    const usable = known.filter(({ body }) => bodyWithId(project, body).surface !== "refine");
    const run = async (factor: number, ofRun: RunControl, finer?: FinerPart): Promise<ElementsMade> => {
      const isSame = factor === 1 && finer === undefined;
      const ofFactor = { ...scaledMeshOptions(options, factor), sizeFactor: factor };
      const finerSize = finer && (await sizeOf(finer.factor));
      const ball = finer && finerSize !== undefined ? ballOf(points, finerSize, finer.share) : undefined;
      const scaled = { ...ofFactor, background: withBall(ofFactor.background, ball) };
      const bodies: PreparedBody[] = [];
      const onBody = (body: PreparedBody) => bodies.push({ ...body, sizeFactor: factor });
      const result = await this.#meshSettled(scaledProject(project, factor), scaled, isSame ? usable : [], {
        ...ofRun,
        onBody,
      });
      return { ...result, bodies };
    };
    const expected =
      automatic !== undefined
        ? await unlessFailed(expectedElements(this, automatic, control))
        : hasBodies(project)
          ? null
          : await this.#expected(project, options, control);
    const hasFinerParts = size !== undefined || automatic !== undefined;
    const { bodies, ...result } = await elementsReached({ elements, expected, run, hasFinerParts }, control);
    const isDone = result.report.status === "done";
    for (const body of isDone ? bodies : []) {
      await untilCancelled<unknown>(() => control.onBody?.(body), control.signal);
    }
    return result;
  }

  /** Returns the expected number of elements of a drawn model; null if it is not known. */
  async #expected(project: Project, options: MeshOptions, { signal }: RunControl): Promise<number | null> {
    const none = new Float64Array();
    const ask = sampleSizes(this.#client, project, none, options, { signal });
    const found = await ask.catch((failure: unknown) => {
      if (failure instanceof MesherError) return null;
      throw failure;
    });
    return found?.tetrahedra ?? null;
  }

  /** Prepares the bodies of a valid project, then meshes it. `options`: valid ones, with the project's settings. */
  async #meshWithBodies(
    project: Project,
    { sizeFactor, ...options }: BodyOptions,
    known: readonly PreparedBody[],
    control: RunControl,
  ): Promise<MeshResult> {
    const began = performance.now();
    const seconds = () => (performance.now() - began) / 1000;
    try {
      const errors = await this.#errorsBefore(project, options, control.signal);
      if (errors.length > 0) return emptyResult("invalid-input", errors, seconds());
      const ready = await preparedBodies(this.#surfaces, project, { ...options, sizeFactor }, known, control);
      const { bodies, diagnostics } = ready;
      if (bodies.length < (project.bodies?.length ?? 0)) {
        return emptyResult("invalid-input", diagnostics, seconds());
      }
      throwIfCancelled(control.signal);
      const later = known.length < bodies.length ? afterBodies(control, seconds()) : control;
      const preparation = seconds();
      const result = await this.#meshModel(project, options, later, joinedBodies(project, bodies));
      const { report } = withBodyDeviations(result, project, bodies);
      const own = withoutBodyNotes(report.diagnostics, project);
      return withPreparation(
        { ...result, report: { ...report, diagnostics: own } },
        preparation,
        diagnostics,
      );
    } catch (failure) {
      if (failure instanceof MesherError && failure.code === "cancelled") {
        return emptyResult("cancelled", [], seconds());
      }
      throw failure;
    }
  }

  /** Returns the errors of what is drawn: nobody wants to wait for the bodies to learn of them. */
  async #errorsBefore(project: Project, options: MeshOptions, signal: AbortSignal | undefined) {
    const { size, innerShells, background } = options;
    const { diagnostics } = await this.previewProject(project, { size, innerShells, background }, { signal });
    return diagnostics.filter(({ severity }) => severity === "error");
  }

  #meshModel(project: Project, options: MeshOptions, control: RunControl, bodies?: BodySurfaceArrays) {
    const { model, grid, name } = drawnRun(project, options);
    const request = {
      kind: "mesh-model",
      id: this.#client.nextId(),
      showFront: control.onFront !== undefined,
      showUnoptimized: control.onUnoptimized !== undefined,
      recordTrace: control.onTrace && { ...control.experiment },
      model,
      bodies,
      grid,
      options: engineOptions(options),
    } as const;
    return this.#run(request, control, { project }, ({ surface }) =>
      bodies === undefined ? name : withPatchOfTriangle(name, surface.trianglePatch),
    );
  }

  async fillSurface(surface: SurfaceInput, options: MeshOptions = {}, control: RunControl = {}) {
    const early = this.#endedEarly(control);
    if (early !== undefined) return early;
    const wrong = [...checkLocatedSurface(surface), ...checkOptions(options)];
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    const { elements } = options;
    if (elements === undefined) return this.#fill(surface, options, control);
    const longest = longestEdge(surface);
    const hasFinerParts = (options.background?.sizes.length ?? 0) === 0;
    const run = (factor: number, ofRun: RunControl, finer?: FinerPart) => {
      const scaled = scaledKeptOptions(options, factor, longest);
      const ball = finer && ballOf(surface.points, longest * finer.factor, finer.share);
      return this.#fill(surface, { ...scaled, background: withBall(scaled.background, ball) }, ofRun);
    };
    const { elementsReached } = await ofElements();
    return elementsReached({ elements, run, isKept: true, hasFinerParts }, control);
  }

  /** Fills a valid surface with valid options. */
  async #fill(surface: SurfaceInput, options: MeshOptions, control: RunControl): Promise<MeshResult> {
    const { background } = options;
    // Copies: transferring the caller's own arrays would empty them.
    const request = {
      kind: "fill-surface",
      id: this.#client.nextId(),
      showFront: control.onFront !== undefined,
      showUnoptimized: control.onUnoptimized !== undefined,
      recordTrace: control.onTrace && { ...control.experiment },
      points: surface.points.slice(),
      triangles: surface.triangles.slice(),
      regions: givenRegionsOf(surface),
      grid: background === undefined ? emptyGrid() : withNodes(emptyGrid(), background),
      options: engineOptions(withInnerShells(surface, options)),
    } as const;
    const name = surfaceNamer(surface);
    // The run takes its place in the queue at once.
    const running = this.#run(request, control, { surface }, () => name);
    const [result, coarse] = await Promise.all([running, inSteps(resolutionWarnings(surface))]);
    const isLost = coarse.some(({ severity }) => severity === "error");
    const diagnostics = isLost ? coarse : [...result.report.diagnostics, ...coarse];
    return coarse.length === 0 ? result : { ...result, report: { ...result.report, diagnostics } };
  }

  async meshSurface(surface: SurfaceInput, options: SurfaceMeshOptions = {}, control: RunControl = {}) {
    const early = this.#endedEarly(control);
    if (early !== undefined) return unmeshed(early);
    return meshedSurface(this, surface, options, control);
  }

  async prepareBody(
    project: Project,
    body: BodyId,
    options: MeshOptions = {},
    control: RunControl = {},
  ): Promise<PreparedBody> {
    beginCall(this.#client, control);
    refuse([...checkProject(project), ...checkOptions(options)]);
    const settled = withSettings(options, project);
    refuse(checkOptions(settled));
    return preparedBody(this.#surfaces, project, bodyWithId(project, body), settled, control);
  }

  async previewProject(
    project: Project,
    options: PreviewOptions = {},
    control: RunControl = {},
  ): Promise<ProjectPreview> {
    beginCall(this.#client, control);
    const unusable = checkPreviewOptions(options);
    const drawn = drawnArrays(project);
    const { size, innerShells, background } = withSettings(unusable.length > 0 ? {} : options, project);
    const wrong = unusable.length > 0 ? unusable : checkPreviewOptions({ size, innerShells, background });
    const hasGrid = background !== undefined && wrong.length === 0;
    const grid = hasGrid ? withNodes(drawn.grid, background) : drawn.grid;
    // Bodies alone need no sizes.
    const isAlone = hasBodies(project) && project.patches.length === 0 && grid.tetrahedra.length === 0;
    const meshing = engineOptions(
      wrong.length > 0 ? {} : { size: isAlone ? (size ?? 1) : size, innerShells },
    );
    const samplesOnly = unusable.length === 0 && options.samplesOnly === true;
    const name = projectNamer(project);
    const answer = await this.#client.ask("previewModel", [drawn.model, grid, meshing, samplesOnly], control);
    const preview = describedPreview(answer, hasGrid ? gridByIndex(name) : name);
    const named = hasGrid ? { ...project, background: undefined } : project;
    const described = preview.diagnostics.map((found) => withMissingId(found, named));
    if (!hasBodies(project)) return { ...preview, diagnostics: [...wrong, ...described] };
    const ofModel = described.filter(({ code }) => code !== "empty-model");
    return { ...preview, diagnostics: [...wrong, ...bodyProblems(project), ...ofModel] };
  }

  async coverProject(
    project: Project,
    options: CoverOptions = {},
    control: RunControl = {},
  ): Promise<ProjectBackground> {
    beginCall(this.#client, control);
    refuse([...checkProject(project), ...checkCoverOptions(options)]);
    const model = modelWithBodyBoxes(project);
    const { size, shape } = engineCoverOptions(options);
    const grid = backgroundFrom(await this.#client.ask("cover", [model, size, shape], control));
    if (grid.tetrahedra.length === 0) refuse([nothingToCover()]);
    const { sources } = backgroundOf(project);
    return { ...projectBackground(grid), ...(sources && { sources }) };
  }

  async proposeSizes(
    project: Project,
    options: ProposalOptions = {},
    control: RunControl = {},
  ): Promise<SizeProposal> {
    beginCall(this.#client, control);
    refuse([...checkProject(project), ...checkProposalOptions(options)]);
    const model = modelWithBodyBoxes(project);
    const answer = await this.#client.ask("propose", [model, engineProposalOptions(options)], control);
    return { size: answer.size, sources: projectSources(answer.sources) };
  }

  async sampleSizes(
    project: Project,
    positions: Float64Array,
    options: ProjectMeshOptions = {},
    control: RunControl = {},
  ): Promise<SizeSamples> {
    beginCall(this.#client, control);
    return sampleSizes(this.#client, project, positions, options, control);
  }

  async backgroundFromMesh(
    mesh: VolumeInput,
    options: { readonly sizes?: Float64Array | undefined } = {},
    control: RunControl = {},
  ): Promise<BackgroundArrays> {
    beginCall(this.#client, control);
    refuse(checkGridOptions(options));
    refuse(checkVolume(mesh, options.sizes));
    const { sizes, ...stretched } = options.sizes === undefined ? sizesAtNodes(mesh) : options;
    refuse(checkVolume(mesh, sizes));
    const { points, tetrahedra } = mesh;
    const none = new Uint32Array();
    const volume = { points: points.slice(), tetrahedra: tetrahedra.slice(), regions: none, front: none };
    const given = [volume, sizes?.slice() ?? new Float64Array()] as const;
    return { ...backgroundFrom(await this.#client.ask("backgroundFromMesh", given, control)), ...stretched };
  }

  async inspectSurface(
    surface: SurfaceInput,
    options: InspectionOptions = {},
    control: RunControl = {},
  ): Promise<SurfaceInspection> {
    return this.#surfaces.inspect(surface, options, control);
  }

  async locateRegions(surface: SurfaceInput, control: RunControl = {}): Promise<RegionLocation> {
    beginCall(this.#client, control);
    return locateRegions(this.#client, surface, control);
  }

  async proposeSurfaceSizes(
    surface: SurfaceInput,
    options: SurfaceProposalOptions = {},
    control: RunControl = {},
  ): Promise<SurfaceSizeProposal> {
    beginCall(this.#client, control);
    return proposeSurfaceSizes(this.#client, surface, options, control);
  }

  async repairSurface(
    surface: SurfaceInput,
    options: RepairOptions = {},
    control: RunControl = {},
  ): Promise<SurfaceRepair> {
    return this.#surfaces.repair(surface, options, control);
  }

  async refineSurface(
    surface: SurfaceInput,
    options: RefineOptions = {},
    control: RunControl = {},
  ): Promise<SurfaceRefinement> {
    return this.#surfaces.refine(surface, options, control);
  }

  async remeshSurface(
    surface: SurfaceInput,
    options: RemeshOptions = {},
    control: PartialControl = {},
  ): Promise<SurfaceRemesh> {
    return this.#surfaces.remesh(surface, options, control);
  }

  async splitPatches(
    surface: SurfaceInput,
    options: SplitOptions = {},
    control: RunControl = {},
  ): Promise<PatchSplit> {
    return this.#surfaces.split(surface, options, control);
  }

  async inspectMesh(mesh: VolumeInput, control: RunControl = {}): Promise<MeshInspection> {
    beginCall(this.#client, control);
    refuse(checkMesh(mesh));
    const { points, tetrahedra, tetrahedronRegion: regions = new Uint32Array() } = mesh;
    const given = [points.slice(), tetrahedra.slice(), regions.slice()] as const;
    const found = await this.#client.ask("inspectMesh", given, control);
    if (!found.isReadable) refuse([unreadableMesh()]);
    return describedMesh(found, mesh.invertedTetrahedra?.length);
  }

  async improveMesh(
    mesh: VolumeInput,
    options: ImproveOptions = {},
    control: PartialControl = {},
  ): Promise<MeshImprovement> {
    beginCall(this.#client, control);
    refuse([...checkImproveInput(mesh), ...checkImproveOptions(options)]);
    const { points, tetrahedra, triangles = new Uint32Array() } = mesh;
    const { tetrahedronRegion: regions = new Uint32Array() } = mesh;
    const given = [
      points.slice(),
      tetrahedra.slice(),
      regions.slice(),
      triangles.slice(),
      engineImproveOptions(options),
    ] as const;
    const found = await this.#client.ask("improveMesh", given, control);
    if (!found.isReadable) refuse([unreadableMesh()]);
    refuse(improvementErrors(found));
    return describedImprovement(found, mesh);
  }

  dispose(): void {
    this.#client.dispose();
  }

  /** As `beginCall` for runs: returns the result if the run cannot succeed. */
  #endedEarly(control: RunControl): MeshResult | undefined {
    const wrong = checkControl(control);
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    this.#client.assertOpen();
    return control.signal?.aborted === true ? emptyResult("cancelled") : undefined;
  }

  async #run(
    request: RunRequest,
    { onUnoptimized, ...control }: RunControl,
    names: NameSource,
    nameFor: (result: EngineResult) => EntityNamer,
  ): Promise<MeshResult> {
    const result = await this.#client.run(request, {
      ...control,
      onUnoptimized: onUnoptimized && ((mesh) => onUnoptimized(namedMesh(mesh, names).mesh)),
    });
    return "cancelledAfterSeconds" in result
      ? emptyResult("cancelled", [], result.cancelledAfterSeconds)
      : describedResult(result, names, nameFor(result));
  }
}
