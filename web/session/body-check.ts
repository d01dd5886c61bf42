import type { Diagnostic, Mesher, Project, ProjectBody } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { meshKey } from "../document/content-keys";
import { engineInput } from "../document/engine-input";
import { bodiesOf, recordsOf } from "../document/entities";
import { strings } from "../strings";
import type { BodyFeed } from "./bodies";
import { settledProject, type DocumentStore } from "./document-store";
import { fillableBodies, touchingBodies } from "./touching-bodies";

export interface BodyCheckState {
  /** Key of the project that was checked last; null before the first check. */
  readonly key: string | null;
  /** The errors that a run of this project would find before it makes tetrahedra; empty if bodies touch. */
  readonly errors: readonly Diagnostic[];
  /** Groups of bodies that touch or intersect, which “Generate mesh” joins. */
  readonly touching: readonly (readonly ProjectBody[])[];
}

type Found = Omit<BodyCheckState, "key">;

const nothing: Found = { errors: [], touching: [] };

/** Largest number of triangles of all bodies that are checked unasked. */
const maxTriangles = 300_000;

/**
 * Finds what a run would refuse: bodies that intersect drawn patches or each other, or lie outside the background grid;
 * and bodies that would be joined.
 * Begins a run as soon as all bodies have up-to-date previews, and ends it when the front has made tetrahedra.
 */
export class BodyCheck {
  readonly state: StoreApi<BodyCheckState> = createStore<BodyCheckState>(() => ({ key: null, ...nothing }));
  readonly #mesher: Promise<Mesher>;
  readonly #bodies: BodyFeed;
  /** The check that is being made. */
  #active: { readonly key: string; readonly abort: AbortController } | null = null;

  constructor(documents: DocumentStore, mesher: Promise<Mesher>, bodies: BodyFeed) {
    this.#mesher = mesher;
    this.#bodies = bodies;
    const update = (): void => this.#update(settledProject(documents.state.getState()));
    documents.onSettled(update);
    bodies.state.subscribe(({ byId }, before) => {
      for (const [id, { preparation }] of byId) {
        if (before.byId.get(id)?.preparation !== preparation) return update();
      }
    });
  }

  #update(project: Project): void {
    if (!canFail(project)) return this.#stop();
    const key = meshKey(project);
    if (key === this.#active?.key || key === this.state.getState().key) return;
    this.#stop();
    const preparedBodies = this.#bodies.preparations.allOf(project);
    const triangles = preparedBodies.reduce((sum, body) => sum + body.triangles.length / 3, 0);
    if (preparedBodies.length < bodiesOf(project).length || triangles > maxTriangles) return;
    const abort = new AbortController();
    this.#active = { key, abort };
    this.#found(project, preparedBodies, abort)
      .then((found) => {
        if (this.#active?.abort === abort) this.state.setState({ key, ...found });
      })
      // A run will report what has failed.
      .catch(() => undefined)
      .finally(() => {
        if (this.#active?.abort === abort) this.#active = null;
      });
  }

  #stop(): void {
    this.#active?.abort.abort();
    this.#active = null;
  }

  async #found(
    project: Project,
    preparedBodies: ReturnType<BodyFeed["preparations"]["allOf"]>,
    abort: AbortController,
  ): Promise<Found> {
    const [input, options] = engineInput(project);
    const mesher = await this.#mesher;
    const given = fillableBodies(this.#bodies.state.getState().byId.values());
    const groups = await touchingBodies(mesher, given, abort.signal);
    if (groups.length > 0) {
      return { errors: [], touching: groups.map((group) => group.map(({ body }) => body)) };
    }
    const { report } = await mesher.meshProject(
      input,
      { ...options, preparedBodies },
      {
        signal: abort.signal,
        onProgress: ({ tetrahedra }) => {
          if (tetrahedra > 0) abort.abort();
        },
      },
    );
    if (report.status !== "invalid-input") return nothing;
    const errors = report.diagnostics.filter(({ severity }) => severity === "error").map(withoutTriangles);
    return { errors, touching: [] };
  }
}

/** Leaves out triangles and nodes of a surface that the page does not have. */
const withoutTriangles = (found: Diagnostic): Diagnostic => ({
  ...found,
  remedy: found.code === "self-intersection" ? strings.bodies.conflict : found.remedy,
  entities: found.entities.filter(({ kind }) => kind === "patch"),
});

/** Returns whether bodies may conflict with something else; a single body is inspected by itself. */
function canFail(project: Project): boolean {
  const bodies = bodiesOf(project).length;
  const { background, meshing } = project;
  const hasGrid = background.tetrahedra.length > 0 && meshing?.size === undefined;
  return bodies > 1 || (bodies > 0 && (hasGrid || recordsOf(project, "patch").length > 0));
}
