import type { Mesher, Project, ProjectPreview } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { engineInput } from "../document/engine-input";
import type { DocumentStore } from "./document-store";
import { failureText } from "./failure-text";

export interface PreviewState {
  /** The sampled lines and patches of `project`; null until the first answer. */
  readonly preview: ProjectPreview | null;
  /** The project that `preview` belongs to: the latest one answered. */
  readonly project: Project | null;
  /** The project whose request failed last, and why; null after an answer. */
  readonly failure: { readonly project: Project; readonly reason: string } | null;
}

/**
 * Keeps the samples of lines and patches and the diagnostics of the check up to date with the document. Makes one
 * request at a time. A newer project cancels the request, but never twice in a row, so that continuous edits still
 * get previews.
 */
export class PreviewFeed {
  readonly state: StoreApi<PreviewState> = createStore<PreviewState>(() => ({
    preview: null,
    project: null,
    failure: null,
  }));
  readonly #documents: DocumentStore;
  readonly #mesher: Promise<Mesher>;
  #next: Project | null = null;
  /** Cancels the active request; null without one. */
  #abort: AbortController | null = null;
  /** Whether a request was cancelled since the last answer; the next request is then not cancelled. */
  #hasGivenUp = false;

  constructor(documents: DocumentStore, mesher: Promise<Mesher>) {
    this.#documents = documents;
    this.#mesher = mesher;
    documents.onProject((project) => this.request(project));
    this.request(documents.project);
  }

  /** Whether a request is active. */
  get busy(): boolean {
    return this.#abort !== null;
  }

  request(project: Project): void {
    this.#next = project;
    if (this.#abort === null) void this.#ask();
    else if (!this.#hasGivenUp) {
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

  async #ask(): Promise<void> {
    while (this.#next) {
      const project = this.#next;
      this.#next = null;
      const abort = new AbortController();
      this.#abort = abort;
      try {
        const [drawn, options] = engineInput(project);
        const control = { signal: abort.signal };
        const preview = await (await this.#mesher).previewProject(drawn, options, control);
        this.#hasGivenUp = false;
        this.state.setState({ preview, project, failure: null });
      } catch (error) {
        if (abort.signal.aborted) continue;
        this.#hasGivenUp = false;
        this.state.setState({ failure: { project, reason: failureText(error) } });
      }
    }
    this.#abort = null;
  }
}
