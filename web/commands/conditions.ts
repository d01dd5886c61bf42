import type { App } from "../app/app";

export const hasSelection = (app: App): boolean => app.view.state.getState().selection.length > 0;

/** Is an element or a triangle of the mesh highlighted? */
export function hasHighlight(app: App): boolean {
  const { element, triangles } = app.view.state.getState();
  return element !== null || triangles.length > 0;
}
