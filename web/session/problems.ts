import { createStore, type StoreApi } from "zustand/vanilla";
import type { PreviewFeed } from "./preview";
import type { MeshRun } from "./run";
import { contentKey } from "../document/content-key";
import type { DocumentStore } from "./document-store";
import { problemsByEntity, toProblems, type Problem } from "../document/validate";

export interface ProblemState {
  readonly problems: readonly Problem[];
  readonly byEntity: ReadonlyMap<string, readonly Problem[]>;
}

/** What is wrong with the project as it now is: what the check says, and what the last run said. */
export class ProblemList {
  readonly state: StoreApi<ProblemState> = createStore<ProblemState>(() => ({
    problems: [],
    byEntity: new Map(),
  }));

  constructor(documents: DocumentStore, previews: PreviewFeed, run: MeshRun) {
    const update = (): void => {
      const { project } = documents;
      const { preview, project: previewed } = previews.state.getState();
      const { outcome } = run.state.getState();
      const key = contentKey(project);
      // While the check of an edit is under way the old findings stay, so that nothing flickers.
      const current = previewed !== null && contentKey(previewed) === key;
      if (!current && previewed !== null && previews.busy) return;
      const problems = toProblems(project, [
        ...(current ? (preview?.diagnostics ?? []) : []),
        // A run looks closer.
        ...(outcome?.key === key ? outcome.result.report.diagnostics : []),
      ]);
      this.state.setState({ problems, byEntity: problemsByEntity(problems) });
    };
    documents.onProject(update);
    previews.state.subscribe(update);
    run.state.subscribe((state, before) => {
      if (state.outcome !== before.outcome) update();
    });
    update();
  }
}
