import type { App } from "../app/app";
import type { RunState } from "../session/run";

export const hasSelection = (app: App): boolean => app.view.state.getState().selection.length > 0;

/** Is an element, a triangle or a position marked? */
export function hasHighlight(app: App): boolean {
  const { element, triangles, markedPosition } = app.view.state.getState();
  return element !== null || triangles.length > 0 || markedPosition !== null;
}

/** Has the shown mesh tetrahedra? A run that was refused or stopped early leaves a surface only. */
export const hasTetrahedra = ({ mesh }: Pick<RunState, "mesh">): boolean =>
  (mesh?.report.tetrahedra ?? 0) > 0;
