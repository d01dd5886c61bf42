import type { Project } from "tetrafront/project";
import { meshKey, shownMeshKey } from "../document/content-keys";
import type { DocumentContent } from "../document/edit";
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
import type { BodyFeed, BodyState } from "./bodies";
import type { BodyCheck, BodyCheckState } from "./body-check";
import { derived, type Readable } from "./derived";
import type { DocumentStore } from "./document-store";
import type { PreviewFeed, PreviewState } from "./preview";
import type { MeshRun } from "./run";
import type { RunState } from "./run-state";

export interface ProblemState {
  readonly problems: readonly Problem[];
  readonly byEntity: ReadonlyMap<string, readonly Problem[]>;
  /** Whether the check of bodies has ended for the present project. */
  readonly areBodiesChecked: boolean;
}

/** What finds problems. */
interface Finders {
  readonly documents: DocumentStore;
  readonly previews: Pick<PreviewFeed, "state">;
  readonly bodies: Pick<BodyFeed, "state">;
  readonly check: Pick<BodyCheck, "state">;
  readonly run: Pick<MeshRun, "state">;
}

/** What is known of a body that can be a problem. */
type KnownBody = Pick<BodyState, "inspection" | "preparationErrors">;

/** The problems of the current project, found by the check and by the last run. */
export class ProblemList {
  readonly state: Readable<ProblemState>;

  constructor({ documents, previews, bodies, check, run }: Finders) {
    // Also during a gesture: its problems are shown as soon as they are known.
    const content = derived((read) => read(documents.state).history.present);
    const outcome = derived((read) => read(run.state).outcome);
    const known = derived<ReadonlyMap<number, KnownBody>>((read, before) => {
      const { byId } = read(bodies.state);
      return before && hasSameFindings(byId, before) ? before : byId;
    });
    this.state = derived<ProblemState>((read, before) => {
      const { project } = read(content);
      const { checked, failure } = read(previews.state);
      // Keep the old problems while the check of an edit runs, so that the list does not flicker.
      const isAwaited = checked !== null && checked !== project && failure?.project !== project;
      if (before && isAwaited) return before;
      const found = { content: read(content), previews: read(previews.state), check: read(check.state) };
      return problemsOf({ ...found, bodies: read(known), outcome: read(outcome) });
    });
  }
}

const hasSameFindings = (a: ReadonlyMap<number, KnownBody>, b: ReadonlyMap<number, KnownBody>): boolean =>
  a.size === b.size &&
  [...a].every(([id, { inspection, preparationErrors }]) => {
    const other = b.get(id);
    return other?.inspection === inspection && other.preparationErrors === preparationErrors;
  });

interface Found {
  readonly content: DocumentContent;
  readonly previews: PreviewState;
  readonly bodies: ReadonlyMap<number, KnownBody>;
  readonly check: BodyCheckState;
  readonly outcome: RunState["outcome"];
}

function problemsOf({ content, previews, bodies, check, outcome }: Found): ProblemState {
  const { project } = content;
  const areBodiesChecked = check.key === meshKey(project);
  const present =
    outcome !== null && [meshKey(project), shownMeshKey(content)].includes(outcome.key) ? outcome : null;
  // An empty project lacks everything; only a run reports that. Bodies need no patches beside them.
  const isDrawn = !isEmptyProject(project) && !hasBodiesOnly(project);
  const ofPreview = previews.checked === project && isDrawn ? previews.preview?.diagnostics : undefined;
  const ofDrawn = toProblems(project, [
    ...(ofPreview ?? []),
    ...(areBodiesChecked ? check.errors : []),
    ...bodiesOf(project).flatMap(({ id }) => bodies.get(id)?.preparationErrors ?? []),
    // A run finds more than the checks do.
    ...(present?.result.report.diagnostics ?? []),
  ]);
  const touching = (areBodiesChecked ? check.touching : []).map((ids) =>
    touchingProblem(bodiesOf(project).filter(({ id }) => ids.includes(id))),
  );
  const ofBodies = bodiesOf(project).flatMap((body) => {
    const inspection = bodies.get(body.id)?.inspection;
    return inspection ? bodyProblems(body, inspection) : [];
  });
  const others = [...(present?.warnings ?? []).map(overlapProblem), ...touching, ...ofBodies];
  const problems = others.length > 0 ? sorted([...ofDrawn, ...others]) : ofDrawn;
  return { problems, byEntity: problemsByEntity(problems), areBodiesChecked };
}

/** Returns whether nothing is drawn beside the bodies. */
function hasBodiesOnly(project: Project): boolean {
  const drawn = (["point", "line", "patch"] as const).some((kind) => recordsOf(project, kind).length > 0);
  return !drawn && bodiesOf(project).length > 0;
}
