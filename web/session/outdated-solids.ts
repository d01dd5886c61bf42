import type { Project, ProjectBody } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { nextBodyIds, replaceBody } from "../document/body-edits";
import { bodiesOf } from "../document/entities";
import { isSolid, solidsOf, type Solid } from "../document/operations/solids";
import type { DocumentStore } from "./document-store";
import { failureText } from "./failure-text";
import { NoSolid, type Solids, withoutSurface } from "./solids";
import { untilState } from "./until-state";

export interface OutdatedSolidsState {
  /** Whether solids are being computed. */
  readonly isPending: boolean;
  /** Why the last one could not be computed. */
  readonly failure: string | null;
}

/** Returns the first solid whose triangles are those of other features. */
const outdatedIn = (project: Project): Solid | undefined =>
  solidsOf(project).find(({ isOutdated }) => isOutdated === true);

/** Makes solids again whose features have changed with a parameter: part of the step of undo of the parameter. */
export class OutdatedSolids {
  readonly state: StoreApi<OutdatedSolidsState> = createStore<OutdatedSolidsState>(() => ({
    isPending: false,
    failure: null,
  }));
  readonly #documents: DocumentStore;
  readonly #solids: Pick<Solids, "bodyOf">;

  constructor(documents: DocumentStore, solids: Pick<Solids, "bodyOf">) {
    this.#documents = documents;
    this.#solids = solids;
    documents.onSettled(() => void this.#follow());
    void this.#follow();
  }

  /** Resolves as soon as all solids are those of their features. Rejects if one cannot be computed, or if it is aborted. */
  async settled(signal: AbortSignal): Promise<void> {
    await this.#follow();
    await untilState(this.state, ({ isPending }) => !isPending, signal);
    const { failure } = this.state.getState();
    if (failure !== null) throw new Error(failure);
  }

  async #follow(): Promise<void> {
    if (this.state.getState().isPending || !outdatedIn(this.#documents.project)) return;
    this.state.setState({ isPending: true, failure: null });
    let failure: string | null = null;
    try {
      for (;;) {
        await this.#documents.afterGesture();
        const { project } = this.#documents;
        const solid = outdatedIn(project);
        if (!solid) break;
        const body = await this.#remade(project, solid);
        await this.#documents.afterGesture();
        this.#replace(solid, body, project);
      }
    } catch (error) {
      failure = failureText(error);
    }
    this.state.setState({ isPending: false, failure });
  }

  /** Returns a solid as its features make it; as it was, with the failures, if they make nothing. */
  async #remade(project: Project, solid: Solid): Promise<ProjectBody> {
    try {
      return await this.#solids.bodyOf(project, solid, solid.features);
    } catch (error) {
      if (error instanceof NoSolid) return { ...solid, failures: error.failures };
      throw error;
    }
  }

  /** Replaces a solid by what its features have given, unless it or the ids that are free have changed meanwhile. */
  #replace(solid: Solid, body: ProjectBody, before: Project): void {
    const { project } = this.#documents;
    const now = bodiesOf(project).find(({ id }) => id === solid.id);
    const isSame = now && isSolid(now) && now.features === solid.features && now.points === solid.points;
    if (!isSame || nextBodyIds(project).firstPatchId !== nextBodyIds(before).firstPatchId) return;
    const { points, triangles, trianglePatch, trueFaces, patches, failures } = body;
    const replaced = {
      ...withoutSurface(now),
      points,
      triangles,
      patches,
      ...(trianglePatch !== undefined && { trianglePatch }),
      ...(trueFaces !== undefined && { trueFaces }),
      ...(failures && { failures }),
    };
    this.#documents.amend(replaceBody(project, "", replaced));
  }
}
