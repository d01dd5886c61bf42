import type { Mesher, PreparedBody } from "tetrafront";
import type { Project, ProjectBody } from "tetrafront/project";
import { preparedKey } from "../document/content-keys";
import type { DrawnSurface } from "../document/drawn-surface";
import { engineInput } from "../document/engine-input";
import { bodiesOf } from "../document/entities";
import type { SurfaceClient } from "../workers/surface-files";

/** The treated triangles of a body, and how the view draws them. */
export interface Preparation {
  /** Key of everything that they depend on. */
  readonly key: string;
  readonly prepared: PreparedBody;
  /** If the body was remeshed, its values are positions on the colour scale of the deviation. */
  readonly drawn: DrawnSurface;
}

/** Number of results kept beside those of the present bodies, so that undo restores the old preview at once. */
const maxOthers = 3;

/**
 * Makes the triangles that a run would mesh. Keeps the results of all bodies, and the last others, by the content that they
 * were made from.
 */
export class BodyPreparations {
  readonly #mesher: Promise<Mesher>;
  readonly #surfaces: SurfaceClient;
  readonly #present: () => Project;
  /** The result made last is the last one. */
  readonly #kept = new Map<string, Preparation>();

  constructor(mesher: Promise<Mesher>, surfaces: SurfaceClient, present: () => Project) {
    this.#mesher = mesher;
    this.#surfaces = surfaces;
    this.#present = present;
  }

  /** Returns the result for the present content of a body, if it is known. */
  find(project: Project, body: ProjectBody): Preparation | null {
    return this.#kept.size === 0 ? null : (this.#kept.get(preparedKey(project, body)) ?? null);
  }

  /** Returns all results that a run of the project can use. */
  allOf(project: Project): readonly PreparedBody[] {
    return bodiesOf(project).flatMap((body) => this.find(project, body)?.prepared ?? []);
  }

  /** Makes the triangles of a body. Rejects if this is impossible or aborted. */
  async make(
    project: Project,
    body: ProjectBody,
    signal: AbortSignal,
    onProgress: (fraction: number) => void,
  ): Promise<Preparation> {
    const [input, options] = engineInput(project);
    const key = preparedKey(project, body);
    const mesher = await this.#mesher;
    const prepared = await mesher.prepareBody(input, body.id, options, {
      signal,
      onProgress: ({ fraction }) => onProgress(fraction),
    });
    return this.#drawn(body, { key, prepared }, signal);
  }

  /** Keeps the triangles of a body that a run of the project has made. */
  keep(project: Project, body: ProjectBody, prepared: PreparedBody): Promise<Preparation> {
    return this.#drawn(body, { key: preparedKey(project, body), prepared });
  }

  async #drawn(
    body: ProjectBody,
    { key, prepared }: Pick<Preparation, "key" | "prepared">,
    signal?: AbortSignal,
  ): Promise<Preparation> {
    const drawn = await this.#surfaces.draw(surfaceOf(prepared), body.patches.length, sharesOf(prepared));
    signal?.throwIfAborted();
    const made = { key, prepared, drawn };
    this.#keep(made);
    return made;
  }

  #keep(made: Preparation): void {
    const project = this.#present();
    this.#kept.delete(made.key);
    this.#kept.set(made.key, made);
    const present = new Set(bodiesOf(project).map((body) => preparedKey(project, body)));
    const others = [...this.#kept.keys()].filter((key) => !present.has(key));
    for (const key of others.slice(0, Math.max(0, others.length - maxOthers))) this.#kept.delete(key);
  }
}

const surfaceOf = ({ points, triangles, trianglePatch }: PreparedBody) => ({
  points,
  triangles,
  trianglePatch,
});

/** Returns the positions on the colour scale: 1 for triangles without deviation, 0 for those at the tolerance. */
function sharesOf(prepared: PreparedBody): Float32Array | null {
  const { triangleDeviation, tolerance = 0 } = prepared;
  if (!triangleDeviation || tolerance === 0) return null;
  return Float32Array.from(triangleDeviation, (deviation) => 1 - deviation / tolerance);
}
