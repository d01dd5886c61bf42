import type { Mesher } from "tetrafront";
import type { DrawnSolid, FeatureFailure, ImportedPart, PartFile } from "tetrafront/internal";
import type { Project, ProjectBody, SolidFeature } from "tetrafront/project";
import { nextBodyIds } from "../document/body-edits";
import type { DrawnSamples, SolidMaker } from "../document/operations/operation";
import { operationStrings } from "../strings";
import { SolidClient, type SolidAnswer } from "../workers/solids";
import type { NewBody } from "../workers/surface-files";
import type { BodyFeed } from "./bodies";

/** Time after which a computation of the kernel is ended, in milliseconds; the first one loads the kernel. */
const limitMs = 180_000;

/** Evaluations that are kept: undo and the panel of a feature ask for the same again. */
const maxKept = 12;

/** Thrown if features give no solid. */
export class NoSolid extends Error {
  readonly failures: readonly FeatureFailure[];

  constructor(failures: readonly FeatureFailure[]) {
    super(failures.map(({ message, remedy }) => `${message} ${remedy}`).join(" "));
    this.failures = failures;
  }
}

/** Returns a body without what a list of features gives it: a solid of one face has no patch per triangle. */
export function withoutSurface<Body extends Partial<ProjectBody>>(body: Body) {
  const { isOutdated: _, failures: _failures, trianglePatch: _patch, trueFaces: _faces, ...kept } = body;
  return kept;
}

/** Asks the kernel, in a worker. */
export type KernelClient = Pick<SolidClient, "evaluate" | "draw" | "importPart" | "dispose">;

/** Evaluates what is drawn. */
type SampleMesher = Pick<Mesher, "previewProject" | "sampleCurvature">;

/** Makes solids of features. */
export class Solids implements SolidMaker {
  readonly #client: KernelClient;
  readonly #bodies: Pick<BodyFeed, "keep">;
  readonly #mesher: Promise<SampleMesher>;
  #running: Promise<void> = Promise.resolve();
  readonly #edges = new Map<string, Promise<SolidAnswer<NewBody>["edges"]>>();

  constructor(
    bodies: Pick<BodyFeed, "keep">,
    mesher: Promise<SampleMesher>,
    client: KernelClient = new SolidClient(),
  ) {
    this.#bodies = bodies;
    this.#mesher = mesher;
    this.#client = client;
  }

  /** Returns a maker whose work is left out if it is aborted before it begins. */
  until(signal: AbortSignal): SolidMaker {
    return {
      bodyOf: (project, before, features) => this.bodyOf(project, before, features, signal),
      edgesOf: (features) => this.edgesOf(features),
      drawn: (features) => this.drawn(features),
      samplesOf: (project, cells) => this.samplesOf(project, cells, signal),
    };
  }

  async bodyOf(
    project: Project,
    before: ProjectBody | { readonly name: string },
    features: readonly SolidFeature[],
    signal?: AbortSignal,
  ): Promise<ProjectBody> {
    const { id, firstPatchId } = nextBodyIds(project);
    const body = "id" in before ? before : { id, name: before.name };
    const request = { features, body: headOf(body), nextPatchId: firstPatchId };
    const { made, failures } = await this.#evaluate(request, signal);
    if (!made) throw new NoSolid(failures);
    this.#bodies.keep(made);
    const { points, triangles, trianglePatch, trueFaces, patches } = made.body;
    const kept = withoutSurface(body);
    return {
      ...kept,
      id: body.id,
      points,
      triangles,
      ...(trianglePatch !== undefined && { trianglePatch }),
      ...(trueFaces !== undefined && { trueFaces }),
      patches,
      features,
      ...(failures.length > 0 && { failures }),
    };
  }

  /** Returns the edges of the solid of features, with the origins of the faces beside each. */
  edgesOf(features: readonly SolidFeature[]): Promise<SolidAnswer<NewBody>["edges"]> {
    const key = JSON.stringify(features);
    const known = this.#edges.get(key);
    if (known) return known;
    const asked = this.#evaluate({ features, body: { id: 1 }, nextPatchId: 1 }).then(({ edges }) => edges);
    this.#edges.set(key, asked);
    asked.catch(() => this.#edges.delete(key));
    for (const oldest of [...this.#edges.keys()].slice(0, -maxKept)) this.#edges.delete(oldest);
    return asked;
  }

  /** Returns the solid of features as lines and patches. */
  drawn(features: readonly SolidFeature[]): Promise<DrawnSolid> {
    return this.#inTurn((client) => client.draw(features));
  }

  async samplesOf(project: Project, cells: number, signal?: AbortSignal): Promise<DrawnSamples> {
    const drawn = { ...project, bodies: [], background: { nodes: [], tetrahedra: [] } };
    const control = signal ? { signal } : {};
    const mesher = await this.#mesher;
    const [lines, patches] = await Promise.all([
      mesher.previewProject(drawn, {}, control),
      mesher.sampleCurvature(drawn, { cells }, control),
    ]);
    return { lines, patches };
  }

  /** Returns the solids of a CAD file, with the names and colours of their faces. */
  importPart(file: PartFile): Promise<ImportedPart> {
    return this.#inTurn((client) => client.importPart(file));
  }

  #evaluate(
    request: Parameters<SolidClient["evaluate"]>[0],
    signal?: AbortSignal,
  ): Promise<SolidAnswer<NewBody>> {
    return this.#inTurn((client) => client.evaluate(request), signal);
  }

  /** Does one task at a time, so that each has its own time. */
  async #inTurn<Answer>(
    task: (client: KernelClient) => Promise<Answer>,
    signal?: AbortSignal,
  ): Promise<Answer> {
    const before = this.#running;
    let done = (): void => undefined;
    this.#running = new Promise((resolve) => (done = resolve));
    await before;
    const limit = new AbortController();
    const timer = setTimeout(() => {
      limit.abort();
      this.#client.dispose();
    }, limitMs);
    try {
      signal?.throwIfAborted();
      return await task(this.#client);
    } catch (failure) {
      throw limit.signal.aborted ? new Error(operationStrings.solids.stopped) : failure;
    } finally {
      clearTimeout(timer);
      done();
    }
  }
}

const headOf = ({ id, name, patches }: Pick<ProjectBody, "id" | "name"> & Partial<ProjectBody>) => ({
  id,
  ...(name !== undefined && { name }),
  ...(patches && { patches }),
});
