import type { App } from "../app/app";
import { deleteEntities } from "../document/edits";
import type { Entity } from "../document/entities";
import type { Problem } from "../document/validate";

export function deleteSelection(app: App): void {
  const { selection } = app.view.state.getState();
  if (selection.length === 0) return;
  app.documents.edit(deleteEntities(app.documents.project, selection));
  app.view.clear();
}

/** Selects entities and moves the view to them. */
export function showEntities(app: App, entities: readonly Entity[]): void {
  app.view.selectAll(entities);
  app.shell.setState({ rightTab: "inspector", leftTab: "model", drawer: null });
  app.viewer.getState().viewer?.fit(entities);
}

/** Selects the first entity of a problem and moves the view to its position. */
export function showProblem(app: App, problem: Problem): void {
  if (problem.entities.length > 0) showEntities(app, problem.entities.slice(0, 1));
  if (problem.code === "outside-background-grid") app.view.setLayer("background", true);
  if (problem.position) app.viewer.getState().viewer?.fitPosition(problem.position);
}

/** Highlights an element of the shown mesh and moves the view to it. */
export function showElement(app: App, tetrahedron: number): void {
  app.view.setLayer("mesh", true);
  app.view.selectElement(tetrahedron);
  app.shell.setState({ drawer: null });
  app.viewer.getState().viewer?.fitSelectedFaces();
}

/** Highlights triangles of the surface that the last run rejected, and moves the view to them. */
export function showTriangles(app: App, triangles: readonly number[]): void {
  app.view.markTriangles(triangles);
  app.shell.setState({ drawer: null });
  app.viewer.getState().viewer?.fitSelectedFaces();
}
