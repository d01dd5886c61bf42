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
  if (problem.body !== null && problem.triangles.length > 0) {
    app.view.markTriangles(problem.triangles, problem.body);
    showGivenTriangles(app);
  }
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

/** Shows the given triangles of bodies instead of a mesh. */
function showGivenTriangles(app: App): void {
  app.view.setLayer("mesh", false);
  app.view.setLayer("bodies", true);
  app.view.state.setState({ bodySurface: "given" });
}

/** Highlights triangles of the surface that the last run rejected, or of a body, and moves the view to them. */
export function showTriangles(app: App, triangles: readonly number[], body: number | null): void {
  app.view.markTriangles(triangles, body);
  if (body !== null) showGivenTriangles(app);
  app.shell.setState({ drawer: null });
  app.viewer.getState().viewer?.fitSelectedFaces();
}
