import type { App } from "../app/app";
import { fixEdit, quickFixOf, type QuickFix } from "../document/quick-fixes";
import type { Problem } from "../document/validate";
import { fixStrings } from "../strings";
import { coverModel, extendGrid } from "./background-actions";

/** Returns the fixes of problems that have one, for the present project, each once. */
export function fixesOf(app: App, problems: readonly Problem[]): readonly QuickFix[] {
  const { project } = app.documents;
  const context = { project, problems: app.problems.state.getState().problems };
  const fixes = problems.flatMap((problem) => quickFixOf(problem, context) ?? []);
  // One fix can solve several problems: one patch closes all open edges around it.
  return [...new Map(fixes.map((fix) => [fix.effect, fix])).values()];
}

/** Makes fixes as one step of undo. */
export function applyFixes(app: App, fixes: readonly QuickFix[]): void {
  const [first] = fixes;
  if (!first) return;
  const { project } = app.documents;
  if (first.cover?.kind === "replace") return void coverModel(app, { size: first.cover.size }, first.label);
  if (first.cover?.kind === "extend") return void extendGrid(app, first.label);
  const label = fixes.length === 1 ? first.label : fixStrings.stepAll(first.label, fixes.length);
  const edit = fixEdit(project, label, fixes);
  if (edit) app.documents.edit(edit);
}
