import type { ElementQuality } from "tetrafront/internal";
import type { App } from "../app/app";
import { deleteEntities, withDependents } from "../document/edits";
import { entityKey, entityName, type Entity } from "../document/entities";
import { groupOfSelection } from "../document/groups";
import { allEntities, withParts } from "../document/select-related";
import type { Position } from "../document/position";
import type { Problem } from "../document/validate";
import { showNotice, type EditedField } from "../session/shell";
import type { RunState } from "../session/run-state";
import { entityNouns, strings } from "../strings";
import type { CameraPose } from "../viewer/camera";

export function deleteSelection(app: App): void {
  const { selection } = app.view.state.getState();
  if (selection.length === 0) return;
  const { project } = app.documents;
  const edit = deleteEntities(project, selection);
  const chosen = new Set(selection.map(entityKey));
  const others = withDependents(project, selection).filter((entity) => !chosen.has(entityKey(entity)));
  app.documents.edit(edit);
  app.view.clear();
  if (others.length === 0) return;
  const { history } = app.documents.state.getState();
  showNotice(app.shell, {
    key: "deleted",
    tone: "information",
    text: strings.notices.deleted(
      edit.label,
      others.map((entity) => entityName(project, entity) ?? `${entityNouns[entity.kind]} ${entity.id}`),
    ),
    action: {
      label: strings.notices.undo,
      run: () => {
        // Only if nothing was changed since.
        if (app.documents.state.getState().history.past.at(-1) === history.past.at(-1)) app.documents.undo();
      },
    },
  });
}

/** Shows entities with all their parts, and hides everything else. */
export function isolate({ documents: { project }, view }: App, entities: readonly Entity[]): void {
  const shown = withParts(project, entities);
  view.setHidden(allEntities(project), true);
  view.setHidden(shown, false);
}

/** Selects entities and moves the view to them. */
export function showEntities(app: App, entities: readonly Entity[]): void {
  app.view.selectAll(entities);
  app.shell.setState({ rightTab: "inspector", leftTab: "model", drawer: null });
  app.viewer.getState().viewer?.framing.fit(entities);
}

/** Selects the first entity of a problem and moves the view to its position. */
export function showProblem(app: App, problem: Problem): void {
  if (problem.entities.length > 0) showEntities(app, problem.entities.slice(0, 1));
  if (problem.body !== null && problem.triangles.length > 0) {
    app.view.markTriangles(problem.triangles, problem.body);
    showGivenTriangles(app);
  }
  if (problem.code === "outside-background-grid") app.view.setLayer("background", true);
  if (problem.position) app.viewer.getState().viewer?.framing.fitPosition(problem.position);
}

/**
 * Highlights an element of the shown mesh, opens a cut to it, and moves the view to it. What covers it gives way: target
 * sizes, and its region if that is hidden.
 */
export async function showElement(app: App, tetrahedron: number): Promise<void> {
  const { mesh } = app.run.state.getState();
  const { viewer } = app.viewer.getState();
  app.view.setLayer("mesh", true);
  app.view.setSizes({ enabled: false });
  app.view.selectElement(tetrahedron);
  app.shell.setState({ drawer: null });
  if (mesh) {
    const region = mesh.mesh.tetrahedronRegion[tetrahedron];
    if (region !== undefined && app.view.state.getState().hiddenRegions.has(region))
      app.view.toggleRegion(region);
    const direction = viewer ? toEye(viewer.pose) : towardsViewer;
    const cut = await app.meshQueries.cutTo(mesh, tetrahedron, direction).catch(() => null);
    const isPresent = app.run.state.getState().mesh === mesh;
    // Another element, or another mesh, was chosen meanwhile.
    if (!isPresent || app.view.state.getState().element !== tetrahedron) return;
    if (cut) app.view.setCut(cut);
  }
  viewer?.framing.fitSelectedFaces();
}

/** The direction of the viewer in the isometric view. */
const towardsViewer: Position = [1, -1, 1];

const toEye = ({ eye, target }: CameraPose): Position => [
  eye[0] - target[0],
  eye[1] - target[1],
  eye[2] - target[2],
];

/** Shows the worst element of the mesh. */
export function showWorstElement(app: App): void {
  const worst = worstElement(app.run.state.getState());
  if (worst) void showElement(app, worst.tetrahedron);
}

/** Returns the worst element of the shown mesh: that with the smallest angle; undefined without elements. */
export const worstElement = ({ mesh }: Pick<RunState, "mesh">): ElementQuality | undefined =>
  mesh?.report.quality.worst[0];

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
  app.viewer.getState().viewer?.framing.fitSelectedFaces();
}

/** Moves the focus to the name of the selected entity, or to its other fields. Nodes of the background grid have no name. */
export function editSelected(app: Pick<App, "shell" | "view">, editing: EditedField): void {
  const hasOne = app.view.state.getState().selection.length === 1;
  app.shell.setState({ rightTab: "inspector", drawer: "right", editing: hasOne ? editing : null });
}

/** Returns whether the inspector shows a name: of the project, of one entity, or of the group that is selected. */
export function canRename({ documents, view }: App): boolean {
  const { selection, element } = view.state.getState();
  if (selection.length > 1) return groupOfSelection(documents.project, selection) !== undefined;
  return element === null;
}

/** Moves the focus to the name of what is selected; without a selection, of the project. */
export const rename = (app: App): void =>
  app.shell.setState({ rightTab: "inspector", drawer: "right", editing: "name" });
