import type { Project } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import type { BodyFeed } from "./bodies";
import type { BodyCheck } from "./body-check";
import type { PreviewFeed } from "./preview";
import type { MeshRun } from "./run";
import { meshKey, shownMeshKey } from "../document/content-keys";
import { type DocumentStore } from "./document-store";
import { bodiesOf, isEmptyProject, recordsOf } from "../document/entities";
import {
  bodyProblems,
  overlapProblem,
  problemsByEntity,
  sorted,
  toProblems,
  touchingProblem,
  type Problem,
} from "../document/validate";

export interface ProblemState {
  readonly problems: readonly Problem[];
  readonly byEntity: ReadonlyMap<string, readonly Problem[]>;
  /** Whether the check of bodies has ended for the present project. */
  readonly areBodiesChecked: boolean;
}

/** The problems of the current project, found by the check and by the last run. */
export class ProblemList {
  readonly state: StoreApi<ProblemState> = createStore<ProblemState>(() => ({
    problems: [],
    byEntity: new Map(),
    areBodiesChecked: false,
  }));

  constructor(
    documents: DocumentStore,
    previews: PreviewFeed,
    bodies: Pick<BodyFeed, "state">,
    check: Pick<BodyCheck, "state">,
    run: MeshRun,
  ) {
    const update = (): void => {
      // Also during a gesture: its problems are shown as soon as they are known.
      const content = documents.state.getState().history.present;
      const { project } = content;
      const { preview, checked } = previews.state.getState();
      const { outcome } = run.state.getState();
      // Keep the old problems while the check of an edit runs, so that the list does not flicker.
      const current = checked === project;
      if (!current && checked !== null && previews.busy) return;
      const areBodiesChecked = check.state.getState().key === meshKey(project);
      const isPresent = outcome !== null && [meshKey(project), shownMeshKey(content)].includes(outcome.key);
      const ofDrawn = toProblems(project, [
        // An empty project lacks everything; only a run reports that. Bodies need no patches beside them.
        ...(current && !isEmptyProject(project) && !hasBodiesOnly(project)
          ? (preview?.diagnostics ?? [])
          : []),
        ...(areBodiesChecked ? check.state.getState().errors : []),
        ...bodiesOf(project).flatMap(
          ({ id }) => bodies.state.getState().byId.get(id)?.preparationErrors ?? [],
        ),
        // A run finds more than the checks do.
        ...(isPresent ? outcome.result.report.diagnostics : []),
      ]);
      const { byId } = bodies.state.getState();
      const touching = (areBodiesChecked ? check.state.getState().touching : []).map((ids) =>
        touchingProblem(bodiesOf(project).filter(({ id }) => ids.includes(id))),
      );
      const ofBodies = bodiesOf(project).flatMap((body) => {
        const inspection = byId.get(body.id)?.inspection;
        return inspection ? bodyProblems(body, inspection) : [];
      });
      const overlaps = isPresent ? outcome.warnings.map(overlapProblem) : [];
      const others = [...overlaps, ...touching, ...ofBodies];
      const problems = others.length > 0 ? sorted([...ofDrawn, ...others]) : ofDrawn;
      this.state.setState({ problems, byEntity: problemsByEntity(problems), areBodiesChecked });
    };
    documents.onSettled(update);
    previews.state.subscribe(update);
    bodies.state.subscribe(({ byId }, before) => {
      for (const [id, { inspection, preparationErrors }] of byId) {
        const last = before.byId.get(id);
        if (last?.inspection !== inspection || last.preparationErrors !== preparationErrors) return update();
      }
    });
    check.state.subscribe(update);
    run.state.subscribe((state, before) => {
      if (state.outcome !== before.outcome) update();
    });
    update();
  }
}

/** Returns whether nothing is drawn beside the bodies. */
function hasBodiesOnly(project: Project): boolean {
  const drawn = (["point", "line", "patch"] as const).some((kind) => recordsOf(project, kind).length > 0);
  return !drawn && bodiesOf(project).length > 0;
}
