import type { App } from "../app/app";

export const hasSelection = (app: App): boolean => app.view.state.getState().selection.length > 0;

/** Is an element, a triangle or a position marked? */
export function hasHighlight(app: App): boolean {
  const { element, triangles, markedPosition } = app.view.state.getState();
  return element !== null || triangles.length > 0 || markedPosition !== null;
}
