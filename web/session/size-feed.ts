import type { Mesher, PreparedBody } from "tetrafront";
import type { Project, ProjectBody } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { engineInput } from "../document/engine-input";
import { bodiesOf, isEmptyProject } from "../document/entities";
import { withoutBodies } from "../document/painted-sizes";
import type { SizePlane, ViewStore } from "../document/selection";
import { sizeSurface, type SizeSurface } from "../document/size-positions";
import { defaultName } from "../strings";
import type { BodyFeed } from "./bodies";
import type { DocumentStore } from "./document-store";
import type { PreviewFeed } from "./preview";
import { isStale, type MeshRun } from "./run";

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
  readonly plane: SizePlane | null;
  readonly enabled: boolean;
  readonly bodies: readonly PreparedBody[];
}

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
  #timer: ReturnType<typeof setTimeout> | undefined;
  #abort: AbortController | null = null;
  #asked: Question | null = null;

  constructor(stores: Stores, mesher: Promise<Mesher>) {
    this.#stores = stores;
    this.#mesher = mesher;
    stores.documents.onLeave(() => {
      this.#forget();
      this.state.setState(nothing);
    });
    stores.documents.onProject(() => this.#postpone());
    stores.previews.state.subscribe(() => this.#changed());
    stores.bodies.state.subscribe(() => this.#changed());
    stores.run.state.subscribe((state, before) => {
      if (state.busy !== before.busy || state.mesh !== before.mesh) this.#changed();
    });
    stores.view.state.subscribe((state, before) => {
      if (state.sizes !== before.sizes) this.#changed();
    });
  }

  #changed(): void {
    if (!this.#isPreviewed()) {
      this.#forget();
      return;
    }
    const question = this.#question();
    if (question && this.#asked && sameQuestion(question, this.#asked)) return;
    this.#asked = question;
    this.#abort?.abort();
    if (!question) {
      this.#stopWaiting();
      this.state.setState(nothing);
    } else {
      if (!question.enabled) this.state.setState({ shown: null });
      this.#wait(question);
    }
  }

  /** Asks when nothing has changed for a while. */
  #wait(question: Question): void {
    this.#stopWaiting();
    this.#timer = setTimeout(() => {
      this.#timer = undefined;
      void this.#ask(question);
    }, restMs);
  }

  #stopWaiting(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  /** The document has changed: its preview comes first, and then calls `#changed()`. It may have come already. */
  #postpone(): void {
    if (this.#asked?.project !== this.#stores.documents.project) this.#forget();
  }

  /** Drops the last question, whose answer would come too late. The sizes that are shown stay. */
  #forget(): void {
    this.#stopWaiting();
    this.#abort?.abort();
    this.#asked = null;
    const { enabled } = this.#stores.view.state.getState().sizes;
    if (!enabled && this.state.getState().shown) this.state.setState({ shown: null });
  }

  /** Whether there is a preview of the present project, or will be none. */
  #isPreviewed(): boolean {
    const { documents, previews } = this.#stores;
    const { project, failure } = previews.state.getState();
    return project === documents.project || failure?.project === documents.project;
  }

  #question(): Question | null {
    const { documents, previews, bodies: feed, run, view } = this.#stores;
    const { project } = previews.state.getState();
    const { enabled, plane } = view.state.getState().sizes;
    if (!project || isEmptyProject(project)) return null;
    const { busy, mesh } = run.state.getState();
    const isKnown = busy || (mesh !== null && !isStale(run.state.getState(), documents.state.getState()));
    if (isKnown && !enabled) return null;
    const bodies = feed.preparations.allOf(project);
    return { project, enabled, plane: enabled ? plane : null, bodies };
  }

  async #ask(question: Question): Promise<void> {
    const { preview } = this.#stores.previews.state.getState();
    if (!preview) return;
    const abort = new AbortController();
    this.#abort = abort;
    const isAborted = (): boolean => abort.signal.aborted;
    const { project, enabled, plane, bodies } = question;
    try {
      const surface = enabled ? await sizeSurface(project, preview, bodies, plane, abort.signal) : null;
      if (isAborted()) return;
      const [drawn, options] = engineInput(project);
      const mesher = await this.#mesher;
      const positions = surface?.points ?? new Float64Array();
      const given = { ...options, preparedBodies: bodies };
      const { sizes, tetrahedra } = await mesher.sampleSizes(drawn, positions, given, {
        signal: abort.signal,
      });
      if (isAborted()) return;
      const missing = unpreparedBodies(project, bodies);
      const rest =
        tetrahedra === null && missing.length > 0
          ? withoutBodies(project, new Set(missing.map(({ id }) => id)))
          : null;
      const counted =
        rest && !isEmptyProject(rest) ? await this.#count(rest, bodies, abort.signal) : tetrahedra;
      if (isAborted()) return;
      const hasSizes = surface !== null && sizes.length > 0;
      this.state.setState({
        expected: counted,
        without: counted === null ? [] : missing.map(nameOfBody),
        shown: hasSizes ? { ...surface, sizes, range: rangeOf(sizes) } : null,
      });
    } catch {
      // A drawing that is not finished has no sizes; its problems say why.
      if (!isAborted()) this.state.setState(nothing);
    }
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
