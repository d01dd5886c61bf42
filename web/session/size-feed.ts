import type { Mesher, PreparedBody } from "tetrafront";
import type { Project, ProjectBody, ProjectPreview } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { engineInput } from "../document/engine-input";
import { bodiesOf, isEmptyProject } from "../document/entities";
import { withoutBodies } from "../document/painted-sizes";
import type { SizePlane, ViewStore } from "../document/selection";
import { sizeSurface, type SizeSurface } from "../document/size-positions";
import { defaultName } from "../strings";
import type { BodyFeed } from "./bodies";
import { derived, type Readable } from "./derived";
import type { DocumentStore } from "./document-store";
import { LatestTask, pause } from "./latest-task";
import type { PreviewFeed } from "./preview";
import type { MeshRun } from "./run";
import { isStale } from "./run-state";

/** Sizes at the positions of a surface. */
export interface ShownSizes extends SizeSurface {
  /** Target edge length per position. */
  readonly sizes: Float64Array;
  /** The smallest and the largest of them. */
  readonly range: readonly [low: number, high: number];
}

export interface SizeState {
  /** The expected number of tetrahedra of the present project; null if it is not known. */
  readonly expected: number | null;
  /** Names of the bodies that the number leaves out, because their triangles are not made yet. */
  readonly without: readonly string[];
  /** The sizes that the view shows; null if it shows none, or the project has no valid sizes. */
  readonly shown: ShownSizes | null;
}

/** Relative difference up to which sizes are equal: interpolation rounds them. */
const equalSizes = 1e-6;

/**
 * Time without a change before sizes are asked for, in milliseconds: an edit by dragging makes many, whose previews would
 * have to wait for the worker.
 */
const restMs = 120;

const nothing: SizeState = { expected: null, without: [], shown: null };

/** What an answer belongs to. */
interface Question {
  readonly project: Project;
  readonly preview: ProjectPreview;
  readonly plane: SizePlane | null;
  readonly enabled: boolean;
  readonly bodies: readonly PreparedBody[];
}

/** A question, nothing to ask, or a preview that comes before the next question. */
type Wish = Question | "nothing" | "preview";

interface Stores {
  readonly documents: DocumentStore;
  readonly previews: PreviewFeed;
  readonly bodies: BodyFeed;
  readonly run: MeshRun;
  readonly view: ViewStore;
}

/**
 * Keeps the sizes that the view shows, and the expected number of elements, up to date with the document. Asks for
 * nothing while a mesh is made, or is up to date and shown.
 */
export class SizeFeed {
  readonly state: StoreApi<SizeState> = createStore<SizeState>(() => nothing);
  readonly #stores: Stores;
  readonly #mesher: Promise<Mesher>;
  readonly #task = new LatestTask();

  constructor(stores: Stores, mesher: Promise<Mesher>) {
    this.#stores = stores;
    this.#mesher = mesher;
    stores.documents.onLeave(() => {
      this.#task.cancel();
      this.state.setState(nothing);
    });
    wishOf(stores).subscribe((wish) => this.#follow(wish));
  }

  #follow(wish: Wish): void {
    this.#task.cancel();
    if (wish === "nothing") return this.state.setState(nothing);
    const isEnabled = wish === "preview" ? this.#stores.view.state.getState().sizes.enabled : wish.enabled;
    if (!isEnabled && this.state.getState().shown) this.state.setState({ shown: null });
    if (wish === "preview") return;
    this.#task
      .run(
        async (signal) => {
          await pause(restMs, signal);
          signal.throwIfAborted();
          return this.#answer(wish, signal);
        },
        (answer) => this.state.setState(answer),
      )
      // A drawing that is not finished has no sizes; its problems say why.
      .catch(() => this.state.setState(nothing));
  }

  async #answer(question: Question, signal: AbortSignal): Promise<SizeState> {
    const { project, preview, plane, enabled, bodies } = question;
    const surface = enabled ? await sizeSurface(project, preview, bodies, plane, signal) : null;
    signal.throwIfAborted();
    const [drawn, options] = engineInput(project);
    const mesher = await this.#mesher;
    const positions = surface?.points ?? new Float64Array();
    const given = { ...options, preparedBodies: bodies };
    const { sizes, tetrahedra } = await mesher.sampleSizes(drawn, positions, given, { signal });
    signal.throwIfAborted();
    const missing = unpreparedBodies(project, bodies);
    const rest =
      tetrahedra === null && missing.length > 0
        ? withoutBodies(project, new Set(missing.map(({ id }) => id)))
        : null;
    const counted = rest && !isEmptyProject(rest) ? await this.#count(rest, bodies, signal) : tetrahedra;
    const hasSizes = surface !== null && sizes.length > 0;
    return {
      expected: counted,
      without: counted === null ? [] : missing.map(nameOfBody),
      shown: hasSizes ? { ...surface, sizes, range: rangeOf(sizes) } : null,
    };
  }

  /** Returns the expected number of tetrahedra of a project whose bodies are all prepared; null if it has none. */
  async #count(
    project: Project,
    bodies: readonly PreparedBody[],
    signal: AbortSignal,
  ): Promise<number | null> {
    const [drawn, options] = engineInput(project);
    const mesher = await this.#mesher;
    const given = { ...options, preparedBodies: bodies };
    return (await mesher.sampleSizes(drawn, new Float64Array(), given, { signal })).tetrahedra;
  }
}

/** Returns the bodies of a project that are not among the prepared ones. */
function unpreparedBodies(project: Project, prepared: readonly PreparedBody[]): readonly ProjectBody[] {
  const known = new Set(prepared.map(({ body }) => body));
  return bodiesOf(project).filter(({ id }) => !known.has(id));
}

const nameOfBody = ({ id, name }: ProjectBody): string => name ?? defaultName("body", id);

/** What to ask for the present project. */
function wishOf({ documents, previews, bodies: feed, run, view }: Stores): Readable<Wish> {
  const present = derived((read) => read(documents.state).history.present.project);
  const shownSizes = derived((read) => read(view.state).sizes);
  const isMeshKnown = derived((read) => {
    const state = read(run.state);
    return state.busy || (state.mesh !== null && !isStale(state, read(documents.state)));
  });
  return derived((read, before: Wish | undefined): Wish => {
    const { project, preview, failure } = read(previews.state);
    if (project !== read(present) && failure?.project !== read(present)) return "preview";
    const { enabled, plane } = read(shownSizes);
    if (!project || !preview || isEmptyProject(project) || (read(isMeshKnown) && !enabled)) return "nothing";
    read(feed.state);
    const bodies = feed.preparations.allOf(project);
    const question = { project, preview, enabled, plane: enabled ? plane : null, bodies };
    return typeof before === "object" && sameQuestion(question, before) ? before : question;
  });
}

function sameQuestion(a: Question, b: Question): boolean {
  const sameBodies = a.bodies.length === b.bodies.length && a.bodies.every((body, i) => body === b.bodies[i]);
  return a.project === b.project && a.plane === b.plane && a.enabled === b.enabled && sameBodies;
}

export function rangeOf(sizes: Float64Array): readonly [low: number, high: number] {
  let [low, high] = [Infinity, 0];
  for (const size of sizes) {
    if (size < low) low = size;
    if (size > high) high = size;
  }
  // Colours would show the rounding of equal sizes.
  return high <= low * (1 + equalSizes) ? [high, high] : [low, high];
}
