/** Runs of the engine: what each is given, and the description of its result. */
import type { RunControl } from "../engine/control.js";
import type { EntityNamer } from "../diagnostics/entity-names.js";
import type { EngineClient, RunRequest } from "../engine/engine-client.js";
import type { EngineResult } from "../engine/protocol.js";
import type { BodySurfaceArrays } from "../generated/constants.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { inSteps } from "../calls/yielder.js";
import { resolutionWarnings } from "../mesh/resolution-warnings.js";
import type { MeshResult } from "../mesh/report.js";
import { emptyGrid, withNodes } from "../project/grid-arrays.js";
import { withPatchOfTriangle } from "../project/names.js";
import type { Project } from "../project/project-types.js";
import type { FinerPart } from "./element-count.js";
import { checkControl, checkLocatedSurface, withInnerShells } from "./input-checks.js";
import { drawnRun } from "./project-run.js";
import type { MeshOptions } from "./option-types.js";
import { checkOptions, engineOptions } from "./mesh-options.js";
import { ballOf, longestEdge, scaledKeptOptions, withBall } from "./scaled-sizes.js";
import { describedResult, emptyResult } from "./report.js";
import { meshedRegionsOf, surfaceNamer } from "./surface-numbers.js";
import { elementBlocks } from "./element-blocks.js";
import { namedMesh, type NameSource } from "./generated-mesh.js";

/** Loaded when a number of elements is asked for. */
export const ofElements = () => import("./counted-surface.js");

/** The runs of an engine: a drawn model, or a given surface, to a mesh. */
export class MeshRuns {
  readonly #client: EngineClient;

  constructor(client: EngineClient) {
    this.#client = client;
  }

  /** As `beginCall` for runs: returns the result if the run cannot succeed. */
  endedEarly(control: RunControl): MeshResult | undefined {
    const wrong = checkControl(control);
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    this.#client.assertOpen();
    return control.signal?.aborted === true ? emptyResult("cancelled") : undefined;
  }

  /** Meshes a valid project with valid options, which include its settings. `bodies`: those of the project. */
  ofModel(project: Project, options: MeshOptions, control: RunControl, bodies?: BodySurfaceArrays) {
    const { model, grid, name } = drawnRun(project, options);
    const request = {
      kind: "mesh-model",
      id: this.#client.nextId(),
      showFront: control.onFront !== undefined,
      showUnoptimized: control.onUnoptimized !== undefined,
      recordTrace: control.onTrace && { ...control.experiment },
      threads: options.threads,
      inBlocks: control.inBlocks === true,
      model,
      bodies,
      grid,
      options: engineOptions(options),
    } as const;
    return this.#run(request, control, { project }, ({ surface }) =>
      bodies === undefined ? name : withPatchOfTriangle(name, surface.trianglePatch),
    );
  }

  /** Fills a surface, until the mesh has the number of elements if one is given. */
  async fill(surface: SurfaceInput, options: MeshOptions, control: RunControl): Promise<MeshResult> {
    const early = this.endedEarly(control);
    if (early !== undefined) return early;
    const wrong = [...checkLocatedSurface(surface), ...checkOptions(options)];
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    const { elements } = options;
    if (elements === undefined) return this.#ofSurface(surface, options, control);
    const longest = longestEdge(surface);
    const hasFinerParts = (options.background?.sizes.length ?? 0) === 0;
    const run = (factor: number, ofRun: RunControl, finer?: FinerPart) => {
      const scaled = scaledKeptOptions(options, factor, longest);
      const ball = finer && ballOf(surface.points, longest * finer.factor, finer.share);
      return this.#ofSurface(surface, { ...scaled, background: withBall(scaled.background, ball) }, ofRun);
    };
    const { elementsReached } = await ofElements();
    return elementsReached({ elements, run, isKept: true, hasFinerParts }, control);
  }

  /** Fills a valid surface with valid options. */
  async #ofSurface(surface: SurfaceInput, options: MeshOptions, control: RunControl): Promise<MeshResult> {
    const { background } = options;
    // Copies: transferring the caller's own arrays would empty them.
    const request = {
      kind: "fill-surface",
      id: this.#client.nextId(),
      showFront: control.onFront !== undefined,
      showUnoptimized: control.onUnoptimized !== undefined,
      recordTrace: control.onTrace && { ...control.experiment },
      threads: options.threads,
      inBlocks: control.inBlocks === true,
      points: surface.points.slice(),
      triangles: surface.triangles.slice(),
      regions: meshedRegionsOf(surface),
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
      : describedResult(result, names, nameFor(result), (indices) =>
          elementBlocks(this.#client, request.id, result, indices),
        );
  }
}
