import type { App } from "../app/app";
import type { RunState } from "../session/run";
import { paletteStrings } from "../strings";
import type { Extra } from "./command";

export const hasSelection = (app: App): boolean => app.view.state.getState().selection.length > 0;

/** For commands that apply to the selection. */
export const needsSelection: Required<Pick<Extra, "enabled" | "needs">> = {
  enabled: hasSelection,
  needs: paletteStrings.needs.selection,
};

/** Is an element, a triangle or a position marked? */
export function hasHighlight(app: App): boolean {
  const { element, triangles, markedPosition } = app.view.state.getState();
  return element !== null || triangles.length > 0 || markedPosition !== null;
}

/** Has the shown mesh tetrahedra? A run that was refused or stopped early leaves a surface only. */
export const hasTetrahedra = ({ mesh }: Pick<RunState, "mesh">): boolean =>
  (mesh?.report.tetrahedra ?? 0) > 0;
