import type { Mesher } from "tetrafront";
import type { Project, ProjectPreview } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { engineInput } from "../document/engine-input";
import type { DocumentStore } from "./document-store";
import { pause } from "./latest-task";
import { changedPart, withPart } from "./part-preview";
import { failureText } from "./failure-text";

export interface PreviewState {
  /** The sampled lines and patches of `project`; null until the first answer. */
  readonly preview: ProjectPreview | null;
  /** The project that `preview` belongs to: the latest one answered. */
  readonly project: Project | null;
  /** The project that the diagnostics of `preview` belong to: the latest one that was checked as a whole. */
  readonly checked: Project | null;
  /** The project whose request failed last, and why; null after an answer. */
  readonly failure: { readonly project: Project; readonly reason: string } | null;
}

const noPreview: PreviewState = { preview: null, project: null, checked: null, failure: null };

/** A preview is slow if it takes longer than this, in milliseconds: continuous edits should be shown 30 times per second. */
const slowMs = 25;
/** A project that was sampled only in part is checked as a whole if no newer one comes for this long, in milliseconds. */
const restMs = 80;

/**
 * Keeps the samples of lines and patches and the diagnostics of the check up to date with the document. Makes one
 * request at a time. A newer project cancels the request, but never twice in a row, so that continuous edits still
 * get previews. If previews of the whole project are slow, only what an edit changes is sampled, and the samples of what it
 * moves by one offset are shifted; the whole is checked as soon as the edits rest.
 */
export class PreviewFeed {
  readonly state: StoreApi<PreviewState> = createStore<PreviewState>(() => noPreview);
  readonly #documents: DocumentStore;
  readonly #mesher: Promise<Mesher>;
  #next: Project | null = null;
  /** Cancels the active request; null without one. */
  #abort: AbortController | null = null;
  /** Whether a request was cancelled since the last answer; the next request is then not cancelled. */
  #hasGivenUp = false;
  /** Whether the last preview of a whole project was slow. */
  #isSlow = false;
  /** The latest project, if it was sampled only in part and still has to be checked; null otherwise. */
  #unchecked: Project | null = null;

  constructor(documents: DocumentStore, mesher: Promise<Mesher>) {
    this.#documents = documents;
    this.#mesher = mesher;
    documents.onLeave(() => this.#forget());
    documents.onProject((project) => this.request(project));
    this.request(documents.project);
  }

  /** Whether a request is active, or a check is to follow. */
  get busy(): boolean {
    return this.#abort !== null;
  }

  request(project: Project): void {
    this.#next = project;
    if (this.#abort === null) void this.#ask();
    else if (this.#unchecked !== null) {
      // The samples are shown already: the check can wait.
      this.#abort.abort();
    } else if (!this.#hasGivenUp) {
      this.#hasGivenUp = true;
      this.#abort.abort();
    }
  }

  /**
   * Returns the samples of the document's project once they are known; null if the document has changed by then. Rejects
   * with the reason if sampling fails.
   */
  samples(): Promise<ProjectPreview | null> {
    const { project } = this.#documents;
    return new Promise((resolve, reject) => {
      const settle = (): boolean => {
        const { preview, project: sampled, failure } = this.state.getState();
        if (this.#documents.project !== project) resolve(null);
        else if (sampled === project) resolve(preview);
        else if (failure?.project === project) reject(new Error(failure.reason));
        else return false;
        return true;
      };
      if (settle()) return;
      const stop = this.state.subscribe(() => {
        if (settle()) stop();
      });
    });
  }

  /** Drops all that belongs to a document that is left. */
  #forget(): void {
    this.#abort?.abort();
    this.#next = null;
    this.#unchecked = null;
    this.state.setState(noPreview);
  }

  async #ask(): Promise<void> {
    while (this.#next ?? this.#unchecked) {
      const abort = new AbortController();
      this.#abort = abort;
      const isAborted = (): boolean => abort.signal.aborted;
      const next = this.#next;
      if (next === null) await pause(restMs, abort.signal);
      const project = next ?? this.#unchecked;
      if (isAborted() || project === null) continue;
      this.#next = null;
      this.#unchecked = null;
      const { left } = this.#documents;
      try {
        if (next !== null && (await this.#samplePart(project, left))) this.#unchecked = project;
        else await this.#sample(project, left, abort.signal);
        this.#hasGivenUp = false;
      } catch (error) {
        if (isAborted()) continue;
        this.#hasGivenUp = false;
        this.state.setState({ failure: { project, reason: failureText(error) } });
      }
    }
    this.#abort = null;
  }

  async #sample(project: Project, left: AbortSignal, signal: AbortSignal): Promise<void> {
    const [drawn, options] = engineInput(project);
    const mesher = await this.#mesher;
    const begin = performance.now();
    const preview = await mesher.previewProject(drawn, options, { signal });
    left.throwIfAborted();
    this.#isSlow = performance.now() - begin > slowMs;
    this.state.setState({ preview, project, checked: project, failure: null });
  }

  /** Samples only what an edit has changed. Returns false if the whole project must be sampled, or can be in time. */
  async #samplePart(project: Project, left: AbortSignal): Promise<boolean> {
    const { preview, project: sampled, failure } = this.state.getState();
    if (!this.#isSlow || !preview || !sampled || failure) return false;
    const part = changedPart(sampled, project);
    if (!part) return false;
    const mesher = await this.#mesher;
    const samples = part.project && (await mesher.previewProject(part.project, { samplesOnly: true }));
    left.throwIfAborted();
    this.state.setState({ preview: withPart(preview, samples, part), project, failure: null });
    return true;
  }
}
