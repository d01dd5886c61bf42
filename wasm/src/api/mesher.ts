/** Implements the mesher: each call in the file of its subject. */
import { adaptMesh } from "./adaptation.js";
import { adaptationCycles } from "./adaptation-cycles.js";
import { addLayers } from "./layers.js";
import { throwIfCancelled, untilCancelled } from "../calls/cancelling.js";
import type { AbortControl, PartialControl, RunControl } from "../engine/control.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { EngineClient } from "../engine/engine-client.js";
import type {
  MeshInspection,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRemesh,
  SurfaceRepair,
} from "../mesh/inspection.js";
import type { MeshAdaptation } from "../mesh/adaptation.js";
import type { LayeredMesh, PatchLayers } from "../mesh/layered-mesh.js";
import type { AdaptationCycle, Solve } from "../mesh/adaptation-cycle.js";
import type { MeshImprovement } from "../mesh/improvement.js";
import type { CurvedEdges, Mesh, SurfaceInput, VolumeInput } from "../mesh/mesh.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { MeshResult } from "../mesh/report.js";
import type { CurvedMesh } from "../mesh/second-order.js";
import type { FieldValues, SolutionSizes, TransferredFields } from "../mesh/solution.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import type { ProjectPreview } from "../project/preview.js";
import type { BodyId, Project, ProjectBackground } from "../project/project-types.js";
import { beginCall } from "./call-checks.js";
import { checkControl } from "./input-checks.js";
import type {
  Mesher,
  PatchSplit,
  ProjectCheck,
  SizeProposal,
  CurvatureSamples,
  SizeSamples,
  SurfaceSizeProposal,
} from "./mesher-interface.js";
import { type RegionLocation, locateRegions } from "./region-location.js";
import { curveMesh } from "./second-order-mesh.js";
import { sampleSizes } from "./size-samples.js";
import { sizeFromSolution, transferSolution } from "./solution.js";
import { proposeSurfaceSizes } from "./surface-sizes.js";
import type {
  CoverOptions,
  CurvatureOptions,
  CycleOptions,
  AdaptOptions,
  LayerOptions,
  ImproveOptions,
  InspectionOptions,
  MeshOptions,
  PreviewOptions,
  ProjectMeshOptions,
  ProposalOptions,
  RefineOptions,
  RemeshOptions,
  RepairOptions,
  SolutionSizeOptions,
  SplitOptions,
  SurfaceMeshOptions,
  SurfaceProposalOptions,
  TransferOptions,
} from "./option-types.js";
import { meshedSurface, unmeshed } from "./surface-meshing.js";
import { SurfaceTools } from "./surface-tools.js";
import { MeshRuns } from "./mesh-runs.js";
import { ProjectTools } from "./project-tools.js";
import { VolumeTools } from "./volume-tools.js";
import { ProjectMesher } from "./project-mesher.js";

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

class WorkerMesher implements Mesher {
  readonly #client = new EngineClient();
  readonly #runs = new MeshRuns(this.#client);
  readonly #surfaces = new SurfaceTools(this.#client);
  readonly #volumes = new VolumeTools(this.#client);
  readonly #projects = new ProjectTools(this.#client);
  readonly #projectMesher = new ProjectMesher({
    client: this.#client,
    runs: this.#runs,
    surfaces: this.#surfaces,
    projects: this.#projects,
    mesher: this,
  });
  readonly ready = this.#client.ready;

  async meshProject(project: Project, options: ProjectMeshOptions = {}, control: RunControl = {}) {
    return this.#projectMesher.mesh(project, options, control);
  }

  async checkProject(
    project: Project,
    options: ProjectMeshOptions = {},
    control: RunControl = {},
  ): Promise<ProjectCheck> {
    return this.#projectMesher.check(project, options, control);
  }

  async prepareBody(
    project: Project,
    body: BodyId,
    options: MeshOptions = {},
    control: RunControl = {},
  ): Promise<PreparedBody> {
    return this.#projectMesher.prepare(project, body, options, control);
  }

  async fillSurface(
    surface: SurfaceInput,
    options: MeshOptions = {},
    control: RunControl = {},
  ): Promise<MeshResult> {
    return this.#runs.fill(surface, options, control);
  }

  async meshSurface(surface: SurfaceInput, options: SurfaceMeshOptions = {}, control: RunControl = {}) {
    const early = this.#runs.endedEarly(control);
    if (early !== undefined) return unmeshed(early);
    return meshedSurface(this, surface, options, control);
  }

  async previewProject(
    project: Project,
    options: PreviewOptions = {},
    control: RunControl = {},
  ): Promise<ProjectPreview> {
    return this.#projects.preview(project, options, control);
  }

  async coverProject(
    project: Project,
    options: CoverOptions = {},
    control: RunControl = {},
  ): Promise<ProjectBackground> {
    return this.#projects.cover(project, options, control);
  }

  async proposeSizes(
    project: Project,
    options: ProposalOptions = {},
    control: RunControl = {},
  ): Promise<SizeProposal> {
    return this.#projects.propose(project, options, control);
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

  async sampleCurvature(
    project: Project,
    options: CurvatureOptions = {},
    control: RunControl = {},
  ): Promise<CurvatureSamples> {
    return this.#projects.curvature(project, options, control);
  }

  async backgroundFromMesh(
    mesh: VolumeInput,
    options: { readonly sizes?: Float64Array | undefined } = {},
    control: RunControl = {},
  ): Promise<BackgroundArrays> {
    return this.#volumes.background(mesh, options, control);
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
    return this.#volumes.inspect(mesh, control);
  }

  async improveMesh(
    mesh: VolumeInput,
    options: ImproveOptions = {},
    control: PartialControl = {},
  ): Promise<MeshImprovement> {
    return this.#volumes.improve(mesh, options, control);
  }

  async adaptMesh(
    mesh: VolumeInput,
    background: VolumeInput,
    options: AdaptOptions = {},
    control: PartialControl = {},
  ): Promise<MeshAdaptation> {
    return adaptMesh(this.#client, { mesh, background }, options, control);
  }

  async addLayers(
    mesh: VolumeInput,
    layers: readonly PatchLayers[],
    options: LayerOptions = {},
    control: PartialControl = {},
  ): Promise<LayeredMesh> {
    return addLayers(this.#client, { mesh, layers }, options, control);
  }

  async curveMesh(mesh: Mesh, curvedEdges?: CurvedEdges, control: RunControl = {}): Promise<CurvedMesh> {
    return curveMesh(this.#client, mesh, curvedEdges, control);
  }

  async sizeFromSolution(
    mesh: VolumeInput,
    fields: readonly FieldValues[],
    options: SolutionSizeOptions,
    control: RunControl = {},
  ): Promise<SolutionSizes> {
    return sizeFromSolution(this.#client, { mesh, fields }, options, control);
  }

  async transferSolution(
    from: VolumeInput,
    to: VolumeInput,
    fields: readonly FieldValues[],
    options: TransferOptions = {},
    control: RunControl = {},
  ): Promise<TransferredFields> {
    return transferSolution(this.#client, { from, to, fields }, options, control);
  }

  adapt(
    model: Project | SurfaceInput | VolumeInput,
    solve: Solve,
    options: CycleOptions,
    control: RunControl = {},
  ): AsyncGenerator<AdaptationCycle, void> {
    return adaptationCycles(this, { model, solve }, options, control);
  }

  dispose(): void {
    this.#client.dispose();
  }
}
