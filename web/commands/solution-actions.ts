/** What the panel of solutions does. Loaded with it. */
import type { App } from "../app/app";
import { adaptToField, runCycles, type CycleSettings, type Target } from "../session/adaptation";
import { failureText } from "../session/failure-text";
import { patchesOf, problemWith, setupIn, type ProblemSetup } from "../session/problem-setup";
import { isStale } from "../session/run-state";
import type { FieldShapes, MeshField } from "../session/solutions";
import { SolveError } from "../solve/problem";
import { stepNames } from "../strings";
import { solutionStrings as texts } from "../strings/solution";
import { FieldView } from "../viewer/field-view";
import { generateMesh } from "./mesh-actions";

/** Keeps a problem in the project, as a step of undo; changes of one number that follow each other are one step. */
export function setUpProblem({ documents }: App, setup: ProblemSetup): void {
  const { project } = documents.state.getState().history.present;
  documents.edit({
    label: stepNames.setProblem,
    mergeKey: changedPart(setupIn(project), setup),
    replace: { problem: problemWith(setup, project) },
  });
}

/** Returns what differs between two problems, in a word: equal words for changes of the same number. */
function changedPart(before: ProblemSetup, after: ProblemSetup): string {
  const isOther = (a: unknown, b: unknown) => JSON.stringify(a) !== JSON.stringify(b);
  const at = after.conditions.findIndex((condition, c) => isOther(condition, before.conditions[c]));
  const parts = [...Object.keys(after), "conditions"].filter((part) =>
    isOther(Reflect.get(before, part), Reflect.get(after, part)),
  );
  const entries = Object.entries(after.conditions[at] ?? {});
  const fields = entries.filter(([key, value]) =>
    isOther(value, Reflect.get(before.conditions[at] ?? {}, key)),
  );
  return ["problem", ...new Set(parts), after.conditions.length, at, ...fields.map(([key]) => key)].join(" ");
}

/** Returns the problem with conditions by the names that the patches have in the shown mesh. */
function setupOf({ documents, run }: App): ProblemSetup {
  const { project } = documents.state.getState().history.present;
  const patches = run.state.getState().mesh?.mesh.patches ?? [];
  // Patches that were renamed since have their earlier names in the mesh.
  const isOfProject = patches.length === patchesOf(project).length;
  return isOfProject
    ? setupIn(
        project,
        patches.map(({ name }) => name),
      )
    : setupIn(project);
}

/**
 * Solves the problem on a mesh of the present model, and adapts the mesh in cycles. Generates a mesh first if there is none. If this
 * fails, the panel says why.
 */
export async function solveInCycles(app: App, settings: CycleSettings): Promise<void> {
  const { left } = app.documents;
  app.solutions.fail(null);
  if (!(await hasPresentMesh(app))) return;
  try {
    await runCycles(app, setupOf(app), settings);
  } catch (error) {
    if (!left.aborted) reportFailure(app, error);
  }
}

/** Adapts the shown mesh to a field. If this fails, the panel says why. */
export async function adaptMesh(app: App, field: MeshField, target: Target): Promise<void> {
  const { left } = app.documents;
  app.solutions.fail(null);
  try {
    await adaptToField(app, field, target);
  } catch (error) {
    if (!left.aborted) reportFailure(app, error);
  }
}

/** What draws the shapes of each app: made when the first one is shown. */
const fieldViews = new WeakMap<App, FieldView>();

/** Shows or hides shapes of the shown field. */
export function showFieldShapes(app: App, change: Partial<FieldShapes>): void {
  if (!fieldViews.has(app)) fieldViews.set(app, new FieldView(app));
  app.solutions.setShapes(change);
}

function reportFailure(app: App, error: unknown): void {
  // The user has stopped the work.
  if (error instanceof DOMException && error.name === "AbortError") return;
  if (isCancelled(error)) return;
  app.solutions.fail(error instanceof SolveError ? textOf(error, setupOf(app)) : failureText(error));
}

function textOf({ failure }: SolveError, { kind }: ProblemSetup): string {
  const isAdvection = failure === "not-converged" && kind === "advection";
  return isAdvection ? texts.advectionNotConverged : texts.failures[failure];
}

const isCancelled = (error: unknown): boolean =>
  typeof error === "object" && error !== null && "code" in error && error.code === "cancelled";

/** Returns whether the present model has a complete mesh, after a run if there is none. If not, the panel says so. */
async function hasPresentMesh(app: App): Promise<boolean> {
  const { run, documents, solutions } = app;
  const { left } = documents;
  const isMissing = (): boolean => {
    const state = run.state.getState();
    return state.mesh === null || isStale(state, documents.state.getState());
  };
  if (isMissing() || run.state.getState().busy) await generateMesh(app);
  if (left.aborted) return false;
  const isPresent = !isMissing() && run.state.getState().mesh?.report.status === "done";
  if (!isPresent) solutions.fail(texts.noMesh);
  return isPresent;
}
