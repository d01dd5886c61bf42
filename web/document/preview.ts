import type { Mesher, Project, ProjectPreview } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { engineInput } from "./engine-input";
import type { DocumentStore } from "./store";

export interface PreviewState {
  /** The sampled lines and patches of `project`; null until the first answer. */
  readonly preview: ProjectPreview | null;
  /** The project that `preview` belongs to: the latest one answered. */
  readonly project: Project | null;
  readonly failure: string | null;
}

/**
 * Keeps the shape of lines and patches, and the list of what is wrong with them, up to date with the
 * document. One request at a time; what changed meanwhile is asked for when the answer is in.
 */
export class PreviewFeed {
  readonly state: StoreApi<PreviewState> = createStore<PreviewState>(() => ({
    preview: null,
    project: null,
    failure: null,
  }));
  readonly #mesher: Promise<Mesher>;
  #wanted: Project | null = null;
  #asking = false;

  constructor(documents: DocumentStore, mesher: Promise<Mesher>) {
    this.#mesher = mesher;
    documents.onProject((project) => this.request(project));
    this.request(documents.project);
  }

  /** Is an answer about the document's present state still to come? */
  get busy(): boolean {
    return this.#asking;
  }

  request(project: Project): void {
    this.#wanted = project;
    if (!this.#asking) void this.#ask();
  }

  async #ask(): Promise<void> {
    this.#asking = true;
    while (this.#wanted) {
      const project = this.#wanted;
      this.#wanted = null;
      try {
        const preview = await (await this.#mesher).previewProject(...engineInput(project));
        this.state.setState({ preview, project, failure: null });
      } catch (error) {
        this.state.setState({ failure: error instanceof Error ? error.message : String(error) });
      }
    }
    this.#asking = false;
  }
}
