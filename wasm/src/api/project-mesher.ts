/** Meshes projects: prepares their bodies, and repeats runs until the mesh has a number of elements. */
import { throwIfCancelled, untilCancelled } from "../calls/cancelling.js";
import type { RunControl } from "../engine/control.js";
import { MesherError, refuse } from "../diagnostics/mesher-error.js";
import type { EngineClient } from "../engine/engine-client.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { MeshResult } from "../mesh/report.js";
import type { BodyId, Project } from "../project/project-types.js";
import {
  automaticBodies,
  type BodyOptions,
  bodyWithId,
  joinedBodies,
  hasBodies,
  preparedBodies,
  preparedBody,
  withBodyEdges,
} from "./body-preparation.js";
import { unlessFailed } from "./best-repair.js";
import { beginCall } from "./call-checks.js";
import type { FinerPart } from "./element-count.js";
import { checkProject } from "./input-checks.js";
import type { Mesher, ProjectCheck } from "./mesher-interface.js";
import { inOneOrder, inOrder } from "./second-order-mesh.js";
import { checkedRun, refused, settledRun } from "./project-run.js";
import { ballOf, largestSize, pointsOf, scaledMeshOptions, scaledProject, withBall } from "./scaled-sizes.js";
import { sampleSizes } from "./size-samples.js";
import { WholeProgress } from "./whole-progress.js";
import type { MeshOptions, ProjectMeshOptions } from "./option-types.js";
import { checkOptions, withSettings } from "./mesh-options.js";
import { emptyResult, withBodyDeviations, withoutBodyNotes, withPreparation } from "./report.js";
import type { SurfaceTools } from "./surface-tools.js";
import { type MeshRuns, ofElements } from "./mesh-runs.js";
import type { ProjectTools } from "./project-tools.js";

/** A mesh, and the bodies that were prepared for it. */
interface ElementsMade extends MeshResult {
  readonly bodies: readonly PreparedBody[];
}

/** What a project is meshed with. */
interface ProjectParts {
  readonly client: EngineClient;
  readonly runs: MeshRuns;
  readonly surfaces: SurfaceTools;
  readonly projects: ProjectTools;
  readonly mesher: Pick<Mesher, "curveMesh" | "proposeSurfaceSizes">;
}

export class ProjectMesher {
  readonly #parts: ProjectParts;

  constructor(parts: ProjectParts) {
    this.#parts = parts;
  }

  async mesh(project: Project, options: ProjectMeshOptions, asked: RunControl): Promise<MeshResult> {
    const early = this.#parts.runs.endedEarly(asked);
    if (early !== undefined) return early;
    const { settled, known, elements, errors } = settledRun(project, options);
    if (errors.length > 0) return emptyResult("invalid-input", errors);
    const control = inOneOrder(asked, options);
    const result =
      elements === undefined
        ? await this.#meshSettled(project, settled, known, control)
        : await this.#meshToElements(project, settled, { elements, known }, control);
    const { signal } = control;
    try {
      return await inOrder(this.#parts.mesher, result, options, { signal });
    } catch (failure) {
      const { total } = result.report.seconds;
      if (failure instanceof MesherError && failure.code === "cancelled")
        return emptyResult("cancelled", [], total);
      throw failure;
    }
  }

  async check(project: Project, options: ProjectMeshOptions, control: RunControl): Promise<ProjectCheck> {
    beginCall(this.#parts.client, control);
    const { settled, known, errors } = settledRun(project, options);
    if (errors.length > 0) return refused(errors);
    if (!hasBodies(project)) return checkedRun(this.#parts.client, { project, options: settled }, control);
    const drawn = await this.#errorsBefore(project, settled, control.signal);
    if (drawn.length > 0) return refused(drawn);
    const whole = new WholeProgress(control);
    const { bodies, diagnostics } = await preparedBodies(
      this.#parts.surfaces,
      project,
      settled,
      known,
      whole.controlOf("bodies"),
    );
    if (bodies.length < (project.bodies?.length ?? 0)) return refused(diagnostics);
    return checkedRun(
      this.#parts.client,
      { project, options: settled, bodies: joinedBodies(project, bodies) },
      whole.next(1),
    );
  }

  async prepare(
    project: Project,
    body: BodyId,
    options: MeshOptions,
    control: RunControl,
  ): Promise<PreparedBody> {
    beginCall(this.#parts.client, control);
    refuse([...checkProject(project), ...checkOptions(options)]);
    const settled = withSettings(options, project);
    refuse(checkOptions(settled));
    return preparedBody(this.#parts.surfaces, project, bodyWithId(project, body), settled, control);
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
    return this.#parts.runs.ofModel(project, own, control);
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
      automatic ? largestAutomaticSize(this.#parts.mesher, automatic, factor) : size && size * factor;
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
        ? await unlessFailed(expectedElements(this.#parts.mesher, automatic, control))
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
    const ask = sampleSizes(this.#parts.client, project, none, options, { signal });
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
    const whole = new WholeProgress(control);
    try {
      const errors = await this.#errorsBefore(project, options, control.signal);
      if (errors.length > 0) return emptyResult("invalid-input", errors, whole.seconds);
      const ready = await preparedBodies(
        this.#parts.surfaces,
        project,
        { ...options, sizeFactor },
        known,
        whole.controlOf("bodies"),
      );
      const { bodies, diagnostics } = ready;
      if (bodies.length < (project.bodies?.length ?? 0)) {
        return emptyResult("invalid-input", diagnostics, whole.seconds);
      }
      throwIfCancelled(control.signal);
      const later = known.length < bodies.length ? whole.next(1) : control;
      const preparation = whole.seconds;
      const result = await this.#parts.runs.ofModel(project, options, later, joinedBodies(project, bodies));
      const { report } = withBodyDeviations(result, project, bodies);
      const own = withoutBodyNotes(report.diagnostics, project);
      const mesh = withBodyEdges(result.mesh, result.surfaceNodes, bodies);
      return withPreparation(
        { ...result, mesh, report: { ...report, diagnostics: own } },
        preparation,
        diagnostics,
      );
    } catch (failure) {
      if (failure instanceof MesherError && failure.code === "cancelled") {
        return emptyResult("cancelled", [], whole.seconds);
      }
      throw failure;
    }
  }

  /** Returns the errors of what is drawn: nobody wants to wait for the bodies to learn of them. */
  async #errorsBefore(project: Project, options: MeshOptions, signal: AbortSignal | undefined) {
    const { size, innerShells, background } = options;
    const { diagnostics } = await this.#parts.projects.preview(
      project,
      { size, innerShells, background },
      { signal },
    );
    return diagnostics.filter(({ severity }) => severity === "error");
  }
}
