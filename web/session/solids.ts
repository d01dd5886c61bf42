import type { FeatureFailure } from "tetrafront/internal";
import type { Project, ProjectBody, SolidFeature } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { nextBodyIds } from "../document/body-edits";
import type { MadeSolid } from "../document/operations/operation";
import { operationStrings } from "../strings";
import { SolidClient, type SolidAnswer } from "../workers/solids";
import type { NewBody } from "../workers/surface-files";
import type { BodyFeed } from "./bodies";

/** Time after which a computation of the kernel is ended, in milliseconds; the first one loads the kernel. */
const limitMs = 180_000;

export interface SolidsState {
  /** By lists of features: those that were left out, and why. */
  readonly failures: ReadonlyMap<readonly SolidFeature[], readonly FeatureFailure[]>;
}

/** Evaluations that are kept: undo and the panel of a feature ask for the same again. */
const maxKept = 12;

/** Makes solids of features. */
export class Solids {
  readonly state: StoreApi<SolidsState> = createStore<SolidsState>(() => ({ failures: new Map() }));
  readonly #client = new SolidClient();
  readonly #bodies: Pick<BodyFeed, "keep">;
  #running: Promise<void> = Promise.resolve();
  readonly #edges = new Map<string, Promise<SolidAnswer<NewBody>["edges"]>>();

  constructor(bodies: Pick<BodyFeed, "keep">) {
    this.#bodies = bodies;
  }

  /**
   * Returns the body of features: with the id and the names of a body, or a new one of a project. Features that fail are left out, and
   * noted. Rejects with a sentence if nothing is left, or if it takes too long.
   */
  async bodyOf(
    project: Project,
    before: ProjectBody | { readonly name: string },
    features: readonly SolidFeature[],
  ): Promise<MadeSolid> {
    const { id, firstPatchId } = nextBodyIds(project);
    const body = "id" in before ? before : { id, name: before.name };
    const { made, failures } = await this.#evaluate({
      features,
      body: headOf(body),
      nextPatchId: firstPatchId,
    });
    if (!made) throw new Error(failures.map(({ message, remedy }) => `${message} ${remedy}`).join(" "));
    this.#bodies.keep(made);
    const { points, triangles, trianglePatch, trueFaces, patches } = made.body;
    const replaced: ProjectBody = {
      ...body,
      points,
      triangles,
      ...(trianglePatch !== undefined && { trianglePatch }),
      ...(trueFaces !== undefined && { trueFaces }),
      patches,
      features,
    };
    const known = [...this.state.getState().failures].slice(1 - maxKept);
    this.state.setState({ failures: new Map([...known, [features, failures]]) });
    return { body: replaced, failures };
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

  async #evaluate(request: Parameters<SolidClient["evaluate"]>[0]): Promise<SolidAnswer<NewBody>> {
    // One at a time, so that each has its own time.
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
      return await this.#client.evaluate(request);
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
