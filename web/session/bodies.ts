import {
  MesherError,
  type Diagnostic,
  type Mesher,
  type PreparedBody,
  type SurfaceInspection,
} from "tetrafront";
import { bodyPatchGroups, type Project, type ProjectBody } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { nextBodyIds } from "../document/body-edits";
import { preparedKey } from "../document/content-keys";
import { defaultRepair, placedVolume, type RepairProposal, type RepairWishes } from "../document/body-repair";
import { bodiesOf } from "../document/entities";
import { nextTurn } from "../document/slices";
import type { PatchArrays } from "../document/patch-arrays";
import { SurfaceClient, type LoadedSurface, type NewBody, type NewPatches } from "../workers/surface-files";
import { BodyPairs, type GivenBody } from "./touching-bodies";
import { BodyPreparations, type Preparation } from "./body-preparations";
import { canCompare, comparedRepair, proposedRepair } from "./body-repairs";
import { BodySurfaces } from "./body-surfaces";
import type { DocumentStore } from "./document-store";
import { failureText } from "./failure-text";
import { LatestTask, LatestTasks } from "./latest-task";
import { untilState } from "./until-state";

/** What is known of a body of the document. */
export interface BodyState {
  /** The body that `loaded`, `inspection` and `repair` belong to, apart from its names, treatment and placement. */
  readonly body: ProjectBody;
  readonly loaded: LoadedSurface | null;
  /** Null until the surface has been inspected. */
  readonly inspection: SurfaceInspection | null;
  /** What a repair would change; null if none is needed, and until it is known. */
  readonly repair: RepairProposal | null;
  /** Progress of the comparison with the exact repair, 0 to 1; null without one. */
  readonly comparing: number | null;
  /** The patches that a split would make; null without a proposal. */
  readonly split: BodySplit | null;
  /** Why the surface could not be read or inspected. */
  readonly failure: string | null;
  /** The preview made last, which may be out of date. */
  readonly preparation: Preparation | null;
  /** Progress of the preview that is being made, 0 to 1; null without one. */
  readonly preparing: number | null;
  /** Why the preview of the present content failed, in a sentence and by errors. */
  readonly preparationFailure: string | null;
  readonly preparationErrors: readonly Diagnostic[];
  /** Key of the content whose preview failed; null without a failure. */
  readonly failedKey: string | null;
}

/** Whether a body can be filled as it is. */
export const isFillable = ({ inspection }: BodyState): boolean => inspection?.isFillable === true;

/** Whether a body can be filled as it is, or after the proposed repair. */
export const canBeFilled = (state: BodyState): boolean =>
  isFillable(state) || state.repair?.after.isFillable === true;

/** Whether it is known if a body can be filled, and what a repair would change otherwise. */
const isSettled = ({ inspection, repair, failure }: BodyState): boolean =>
  failure !== null || inspection?.isFillable === true || (inspection !== null && repair !== null);

/** Returns the bodies that can be filled as they are. */
export function fillableBodies(states: Iterable<BodyState>): GivenBody[] {
  return [...states].flatMap(({ body, loaded, inspection }) =>
    loaded && inspection?.isFillable === true
      ? [
          {
            body,
            surface: loaded.surface,
            volume: placedVolume(inspection.volume, body),
            regions: inspection.regions,
            isPlain: inspection.regions === 1 && inspection.flippedTriangles === 0,
          },
        ]
      : [],
  );
}

/** A proposed split of patches by angle. */
export interface BodySplit {
  /** Id of the patch that is split; null for all. */
  readonly patch: number | null;
  readonly split: NewPatches;
  /** The body after the split. */
  readonly after: NewBody;
}

export interface BodiesState {
  readonly byId: ReadonlyMap<number, BodyState>;
}

/** Largest number of given triangles of which a preview is made unasked: it takes some seconds. */
const maxUnaskedTriangles = 30_000;

const noErrors: readonly Diagnostic[] = [];
const noFailure = { preparationFailure: null, preparationErrors: noErrors, failedKey: null } as const;

const unknownBody = (body: ProjectBody): BodyState => ({
  body,
  loaded: null,
  inspection: null,
  repair: null,
  comparing: null,
  split: null,
  failure: null,
  preparation: null,
  preparing: null,
  ...noFailure,
});

/** Loads and inspects the bodies of the document, and makes previews of their treated triangles. */
export class BodyFeed {
  readonly state: StoreApi<BodiesState> = createStore<BodiesState>(() => ({ byId: new Map() }));
  readonly preparations: BodyPreparations;
  /** Which bodies touch. */
  readonly pairs = new BodyPairs();
  readonly #documents: DocumentStore;
  readonly #mesher: Promise<Mesher>;
  readonly #client = new SurfaceClient();
  readonly #surfaces = new BodySurfaces(this.#client);
  /** Previews that are being made, by body. */
  readonly #previews = new LatestTasks<number>();
  /** Keys of their contents. */
  readonly #making = new Map<number, string>();
  /** Proposals and comparisons of repairs that are being made, by body. */
  readonly #repairs = new LatestTasks<number>();
  /** Ids of bodies whose preview is made as soon as they are inspected. */
  readonly #awaited = new Set<number>();
  /** The proposal of a split that is being made. */
  readonly #splitting = new LatestTask();

  constructor(documents: DocumentStore, mesher: Promise<Mesher>) {
    this.#documents = documents;
    this.#mesher = mesher;
    this.preparations = new BodyPreparations(mesher, this.#client, () => documents.project);
    documents.onLeave(() => this.#forget());
    documents.onProject((project) => this.#follow(project));
    this.#follow(documents.project);
  }

  /** Notes the arrays of a new body, so that it is shown as soon as it is in the document. */
  keep(made: Pick<NewBody, "body" | "loaded">): void {
    this.#surfaces.keep(made);
  }

  /** Makes a preview of the treated triangles of a body. A preview of the same body that is being made is aborted. */
  async prepare(id: number): Promise<void> {
    const { project } = this.#documents;
    const body = bodiesOf(project).find((other) => other.id === id);
    if (!body) return;
    const key = preparedKey(project, body);
    this.#making.set(id, key);
    this.#set(id, { preparing: 0, ...noFailure });
    const make = async (signal: AbortSignal): Promise<Preparation> =>
      this.preparations.find(project, body) ??
      this.preparations.make(project, body, signal, (preparing) => {
        if (!signal.aborted) this.#set(id, { preparing });
      });
    const end = (change: Partial<BodyState>): void => {
      this.#making.delete(id);
      this.#set(id, { preparing: null, ...change });
    };
    try {
      await this.#previews.of(id).run(make, (preparation) => end({ preparation }));
    } catch (error) {
      const isRefused = error instanceof MesherError && error.code === "invalid-input";
      const preparationErrors = isRefused ? error.data.diagnostics : noErrors;
      end({ preparationFailure: failureText(error), preparationErrors, failedKey: key });
    }
  }

  /**
   * Waits until no preview is being made, so that a run uses its triangles instead of making them again. Previews of outdated
   * content are aborted. Rejects if `signal` is aborted; the previews then go on.
   */
  async previewed(signal: AbortSignal, onProgress: (fraction: number) => void): Promise<void> {
    const { project } = this.#documents;
    const present = new Map(bodiesOf(project).map((body) => [body.id, preparedKey(project, body)]));
    for (const [id, key] of [...this.#making]) if (present.get(id) !== key) this.cancel(id);
    const fractions = (): number[] =>
      [...this.state.getState().byId.values()].flatMap(({ preparing }) => preparing ?? []);
    const report = (): void => {
      const made = fractions();
      if (made.length > 0) onProgress(Math.min(...made));
    };
    report();
    const stop = this.state.subscribe(report);
    try {
      await untilState(this.state, () => fractions().length === 0, signal);
    } finally {
      stop();
    }
  }

  /**
   * Keeps the triangles of a body that a run of the project has made. They are its preview if nothing that they depend on has
   * changed since. If they cannot be drawn, there is none.
   */
  async keepPrepared(project: Project, prepared: PreparedBody): Promise<void> {
    const body = bodiesOf(project).find(({ id }) => id === prepared.body);
    if (!body) return;
    const preparation = await this.preparations.keep(project, body, prepared).catch(() => null);
    const present = this.#documents.project;
    const same = bodiesOf(present).find(({ id }) => id === body.id);
    if (!preparation || !same || preparedKey(present, same) !== preparation.key) return;
    this.#setFor(same, { preparation, ...noFailure });
  }

  /**
   * Resolves when it is known of each body whether it can be filled, and what a repair would change otherwise. Rejects if it is
   * aborted.
   */
  settled(signal: AbortSignal): Promise<void> {
    return untilState(this.state, ({ byId }) => [...byId.values()].every(isSettled), signal);
  }

  /** Makes a preview as soon as the surface is known to be valid, unless it is large. */
  prepareWhenValid(id: number): void {
    this.#awaited.add(id);
    this.#prepareAwaited();
  }

  #prepareAwaited(): void {
    const { byId } = this.state.getState();
    for (const id of this.#awaited) {
      const inspection = byId.get(id)?.inspection;
      if (!inspection) continue;
      this.#awaited.delete(id);
      if (inspection.isFillable && inspection.triangles <= maxUnaskedTriangles) void this.prepare(id);
    }
  }

  /** Aborts the preview of a body. */
  cancel(id: number): void {
    this.#previews.of(id).cancel();
    this.#making.delete(id);
    this.#set(id, { preparing: null });
  }

  /** Returns a body with another surface and other patches, whose arrays are then known. */
  async replaced(
    body: ProjectBody,
    surface: PatchArrays,
    patches: ProjectBody["patches"],
  ): Promise<ProjectBody> {
    const made = await this.#client.replace({ body, surface, patches });
    this.keep(made);
    return made.body;
  }

  /** Returns a body with the patches of a split. Its arrays are then known. */
  async withSplit(body: ProjectBody, split: NewPatches): Promise<ProjectBody> {
    const made = await this.#split(body, split, false);
    this.keep(made);
    return made.body;
  }

  /** Returns a body in which some patches are merged into the first of them. Its arrays are then known. */
  async withMerged(body: ProjectBody, ids: readonly number[]): Promise<ProjectBody> {
    const made = await this.#client.merge(body, ids);
    this.keep(made);
    return made.body;
  }

  /** Finds out what a repair would change, and whether problems would remain. */
  async proposeRepair(body: ProjectBody, wishes: RepairWishes = defaultRepair): Promise<void> {
    this.cancelComparison(body.id);
    try {
      const propose = async (signal: AbortSignal): Promise<RepairProposal> => {
        const loaded = await this.#surfaces.load(body);
        return proposedRepair(await this.#mesher, body, loaded, wishes, { signal });
      };
      let proposed: RepairProposal | null = null;
      await this.#repairs.of(body.id).run(propose, (repair) => {
        proposed = repair;
        this.#setFor(body, { repair });
      });
      await this.#compareIfSmall(body, proposed);
    } catch (error) {
      this.#setFor(body, { failure: failureText(error) });
    }
  }

  async #compareIfSmall(body: ProjectBody, repair: RepairProposal | null): Promise<void> {
    const isSmall = repair !== null && repair.after.triangles <= maxUnaskedTriangles;
    if (isSmall && canCompare(body, repair)) await this.compareRepairs(body);
  }

  /** Tries the exact repair beside the proposed one, and proposes the better one. */
  async compareRepairs(body: ProjectBody): Promise<void> {
    const repair = this.state.getState().byId.get(body.id)?.repair;
    if (!repair || !canCompare(body, repair)) return;
    this.#setFor(body, { comparing: 0 });
    const compare = async (signal: AbortSignal): Promise<RepairProposal> =>
      comparedRepair(await this.#mesher, body, await this.#surfaces.load(body), repair, {
        signal,
        onProgress: (comparing) => !signal.aborted && this.#setFor(body, { comparing }),
      });
    try {
      await this.#repairs
        .of(body.id)
        .run(compare, (compared) => this.#setFor(body, { repair: compared, comparing: null }));
    } catch (error) {
      // The proposed repair stays: the body can still be repaired without a comparison.
      this.#setFor(body, { failure: failureText(error), comparing: null });
    }
  }

  /** Ends the comparison of two repairs of a body; the proposed one stays. */
  cancelComparison(id: number): void {
    this.#repairs.of(id).cancel();
    if (this.state.getState().byId.get(id)?.comparing != null) this.#set(id, { comparing: null });
  }

  /** Shows which patches a split along edges with a larger angle would make, of one patch or of all. */
  async proposeSplit(body: ProjectBody, angle: number, patch: number | null): Promise<void> {
    const split = async (signal: AbortSignal): Promise<BodySplit> => {
      const { surface } = await this.#surfaces.load(body);
      const mesher = await this.#mesher;
      const patches = patch === null ? undefined : [body.patches.findIndex(({ id }) => id === patch)];
      const given = { ...surface, patches: bodyPatchGroups(body) };
      const { mesh } = await mesher.splitPatches(given, { angle, patches }, { signal });
      return { patch, split: mesh, after: await this.#split(body, mesh, true) };
    };
    await this.#splitting.run(split, (proposed) => {
      const present = this.state.getState().byId.get(body.id)?.body;
      if (present?.patches === body.patches) this.#setFor(body, { split: proposed });
    });
  }

  dropSplit(id: number): void {
    this.#splitting.cancel();
    this.#set(id, { split: null });
  }

  #split(body: ProjectBody, split: NewPatches, isPreview: boolean): Promise<NewBody> {
    const { firstPatchId } = nextBodyIds(this.#documents.project);
    return this.#client.split(body, split, firstPatchId, isPreview);
  }

  /** Ends all that is made for the bodies of a document that is left: those of another one may have the same ids. */
  #forget(): void {
    this.#previews.cancelBut(new Set());
    this.#repairs.cancelBut(new Set());
    this.#making.clear();
    this.#awaited.clear();
    this.#splitting.cancel();
    this.state.setState({ byId: new Map() });
  }

  #follow(project: Project): void {
    const bodies = bodiesOf(project);
    const { byId } = this.state.getState();
    if (bodies.length === 0 && byId.size === 0) return;
    const next = new Map(bodies.map((body) => [body.id, this.#followed(project, body, byId.get(body.id))]));
    for (const tasks of [this.#previews, this.#repairs]) tasks.cancelBut(next);
    this.state.setState({ byId: next });
    for (const { body, loaded, inspection, failure } of next.values()) {
      if (failure === null && (!loaded || !inspection)) void this.#inspect(body);
    }
  }

  #followed(project: Project, body: ProjectBody, before: BodyState | undefined): BodyState {
    const isSame = before !== undefined && hasSameSurface(before.body, body);
    if (!isSame) this.#repairs.of(body.id).cancel();
    const known = isSame ? { ...before, body } : unknownBody(body);
    const isFailed = known.failedKey !== null && known.failedKey === preparedKey(project, body);
    const state = known.failedKey === null || isFailed ? known : { ...known, ...noFailure };
    const preparation = this.preparations.find(project, body) ?? state.preparation;
    // A split names its patches by those of the body.
    const split = before?.body.patches === body.patches ? state.split : null;
    return { ...state, split, preparation, loaded: this.#surfaces.find(body) ?? state.loaded };
  }

  async #inspect(body: ProjectBody): Promise<void> {
    try {
      const loaded = await this.#surfaces.load(body);
      this.#setFor(body, { loaded });
      const mesher = await this.#mesher;
      // The page shows a large surface first: copying it to the worker is a task of its own.
      await nextTurn();
      const inspection = await mesher.inspectSurface(loaded.surface);
      this.#setFor(body, { inspection });
      this.#prepareAwaited();
      // A proposal for a surface that was replaced meanwhile would end that for the present one.
      const present = this.state.getState().byId.get(body.id)?.body;
      const isPresent = present !== undefined && hasSameSurface(present, body);
      if (isPresent && !inspection.isFillable) await this.proposeRepair(body);
    } catch (error) {
      this.#setFor(body, { failure: failureText(error) });
    }
  }

  /** Changes the state of a body, unless its surface has changed meanwhile. */
  #setFor(body: ProjectBody, change: Partial<BodyState>): void {
    const present = this.state.getState().byId.get(body.id);
    if (present && hasSameSurface(present.body, body)) this.#set(body.id, change);
  }

  #set(id: number, change: Partial<BodyState>): void {
    const { byId } = this.state.getState();
    const present = byId.get(id);
    if (!present) return;
    const next = new Map(byId);
    next.set(id, { ...present, ...change });
    this.state.setState({ byId: next });
  }
}

function hasSameSurface(a: ProjectBody, b: ProjectBody): boolean {
  return a.trianglePatch === b.trianglePatch && a.triangles === b.triangles && a.points === b.points;
}
