import { createStore, type StoreApi } from "zustand/vanilla";
import type { PreviewFeed } from "./preview";
import type { MeshRun } from "./run";
import { meshKey } from "../document/content-keys";
import { settledProject, type DocumentStore } from "./document-store";
import { isEmptyProject } from "../document/entities";
import { problemsByEntity, toProblems, type Problem } from "../document/validate";

export interface ProblemState {
  readonly problems: readonly Problem[];
  readonly byEntity: ReadonlyMap<string, readonly Problem[]>;
}

/** The problems of the current project, found by the check and by the last run. */
export class ProblemList {
  readonly state: StoreApi<ProblemState> = createStore<ProblemState>(() => ({
    problems: [],
    byEntity: new Map(),
  }));

  constructor(documents: DocumentStore, previews: PreviewFeed, run: MeshRun) {
    const update = (): void => {
      const project = settledProject(documents.state.getState());
      const { preview, project: previewed } = previews.state.getState();
      const { outcome } = run.state.getState();
      // Keep the old problems while the check of an edit runs, so that the list does not flicker.
      const current = previewed === project;
      if (!current && previewed !== null && previews.busy) return;
      const problems = toProblems(project, [
        // An empty project lacks everything; only a run reports that.
        ...(current && !isEmptyProject(project) ? (preview?.diagnostics ?? []) : []),
        // A run finds more than the check does.
        ...(outcome?.key === meshKey(project) ? outcome.result.report.diagnostics : []),
      ]);
      this.state.setState({ problems, byEntity: problemsByEntity(problems) });
    };
    documents.onSettled(update);
    previews.state.subscribe(update);
    run.state.subscribe((state, before) => {
      if (state.outcome !== before.outcome) update();
    });
    update();
  }
}
