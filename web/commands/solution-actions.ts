/** What the panel of solutions does. Loaded with it. */
import type { MeshResult } from "tetrafront";
import type { App } from "../app/app";
import { adaptToField, runCycles, type CycleSettings, type Target } from "../session/adaptation";
import { failureText } from "../session/failure-text";
import { defaultSetup, type ProblemSetup } from "../session/problem-setup";
import { isStale } from "../session/run";
import type { FieldShapes, MeshField } from "../session/solutions";
import { SolveError } from "../solve/problem";
import { solutionStrings as texts } from "../strings/solution";
import { FieldView } from "../viewer/field-view";

/** Returns the problem that the user has stated, at first the usual one. */
export const setupOf = ({ solutions }: App): ProblemSetup => solutions.state.getState().setup ?? defaultSetup;

/**
 * Solves the problem on a mesh of the present model, and adapts the mesh in cycles. Generates a mesh first if there is none. If this
 * fails, the panel says why.
 */
export async function solveInCycles(app: App, settings: CycleSettings): Promise<void> {
  const { solutions } = app;
  solutions.fail(null);
  if (!(await presentMesh(app))) return;
  try {
    await runCycles(app, setupOf(app), settings);
  } catch (error) {
    reportFailure(app, error);
  }
}

/** Adapts the shown mesh to a field. If this fails, the panel says why. */
export async function adaptMesh(app: App, field: MeshField, target: Target): Promise<void> {
  app.solutions.fail(null);
  try {
    await adaptToField(app, field, target);
  } catch (error) {
    reportFailure(app, error);
  }
}

/** What draws the shapes of each app: made when the first one is shown. */
const fieldViews = new WeakMap<App, FieldView>();

/** Shows or hides shapes of the shown field. The surfaces of the mesh and of bodies would hide an isosurface. */
export function showFieldShapes(app: App, change: Partial<FieldShapes>): void {
  if (!fieldViews.has(app)) fieldViews.set(app, new FieldView(app));
  const { isosurface: before } = app.solutions.state.getState().shapes;
  app.solutions.setShapes(change);
  const { isosurface } = change;
  if (isosurface === undefined || (isosurface === null) === (before === null)) return;
  for (const layer of ["mesh", "bodies"] as const) app.view.setLayer(layer, isosurface === null);
}

function reportFailure({ solutions }: App, error: unknown): void {
  // The user has stopped the work.
  if (error instanceof DOMException && error.name === "AbortError") return;
  if (isCancelled(error)) return;
  solutions.fail(error instanceof SolveError ? texts.failures[error.failure] : failureText(error));
}

const isCancelled = (error: unknown): boolean =>
  typeof error === "object" && error !== null && "code" in error && error.code === "cancelled";

/** Returns the mesh of the present model, after a run if there is none; null if the run makes none. */
async function presentMesh({ run, documents }: App): Promise<MeshResult | null> {
  const isMissing = (): boolean => {
    const state = run.state.getState();
    return state.mesh === null || isStale(state, documents.state.getState());
  };
  if (isMissing() || run.state.getState().busy) await run.generate();
  const { mesh } = run.state.getState();
  return isMissing() || mesh?.report.status !== "done" ? null : mesh;
}
