import type { App } from "../app/app";
import type { RunState } from "../session/run-state";
import { paletteStrings } from "../strings";
import type { Extra } from "./command";

export const hasSelection = (app: App): boolean => app.view.state.getState().selection.length > 0;

/** Returns that a selection is needed; null if there is one, because a command is then disabled for another reason. */
export const selectionNeeded = (app: App): string | null =>
  hasSelection(app) ? null : paletteStrings.needs.selection;

/** Returns that a mesh is needed, or that a run is working on it. */
export function meshNeeded({ run }: App): string {
  const { busy, task } = run.state.getState();
  return busy ? paletteStrings.needs.running[task] : paletteStrings.needs.mesh;
}

/** For commands that apply to the selection. */
export const needsSelection: Pick<Extra, "enabled" | "needs"> = {
  enabled: hasSelection,
  needs: selectionNeeded,
};

/** Is an element, a triangle or a position marked? */
export function hasHighlight(app: App): boolean {
  const { element, triangles, markedPosition } = app.view.state.getState();
  return element !== null || triangles.length > 0 || markedPosition !== null;
}

/** Has the shown mesh tetrahedra? A run that was refused or stopped early leaves a surface only. */
export const hasTetrahedra = ({ mesh }: Pick<RunState, "mesh">): boolean =>
  (mesh?.report.tetrahedra ?? 0) > 0;
