import type { MeshResult, Project } from "tetrafront";
import type { App } from "../app/app";
import { emptyProject, type Creation, type Offer } from "../document/create";
import { deleteEntities } from "../document/edits";
import type { Entity } from "../document/entities";
import { download, fileStem, openProjectFile, readProjectFile, saveProjectFile } from "../session/files";
import type { OpenResult } from "../session/files";
import { loadModel, type GalleryModel } from "../session/gallery";
import type { Problem } from "../document/validate";
import { writeMeshFiles } from "../workers/mesh-writer";
import { formatCount } from "../ui/format";
import { strings } from "../ui/strings";

/** What commands and panels do that concerns more than one room. */

function tell(app: App, title: string, lines: readonly string[]): void {
  app.shell.setState({ message: { title, lines } });
}

/** Shows another project in place of the present one. Undoable. */
function showProject(app: App, project: Project, label: string): void {
  app.documents.open(project, label);
  app.run.forgetOthers();
  app.file.handle = null;
  app.view.reset();
  app.view.setCut({ enabled: false });
  app.viewer.getState().viewer?.setProject(app.documents.project, true);
  app.shell.setState({ drawer: null, leftTab: "model", message: null });
}

/** Shows another project and meshes it at once. Undoable. */
export function openProject(app: App, project: Project): void {
  showProject(app, project, `Open ${project.name}`);
  void app.run.restart();
}

/** An empty project, to draw in. Undoable. */
export function newProject(app: App): void {
  app.run.cancel();
  showProject(app, emptyProject(), "New project");
}

export async function openExample(app: App, model: GalleryModel): Promise<void> {
  try {
    openProject(app, await loadModel(model));
  } catch (error) {
    tell(app, strings.messages.openFailed(model.title), [String(error)]);
  }
}

function takeOpened(app: App, result: OpenResult): void {
  if (result.kind === "opened") openProject(app, result.project);
  else if (result.kind === "failed") tell(app, strings.messages.openFailed(result.fileName), result.reasons);
}

export async function openFromDialog(app: App): Promise<void> {
  try {
    takeOpened(app, await openProjectFile());
  } catch (error) {
    tell(app, strings.messages.noOpenDialog, [String(error)]);
  }
}

export async function openDropped(app: App, file: File): Promise<void> {
  takeOpened(app, await readProjectFile(file));
}

/** Saves into the file saved before, or asks for one. */
export async function save(app: App, askForName: boolean): Promise<void> {
  try {
    const saved = await saveProjectFile(app.documents.project, askForName ? null : app.file.handle);
    if (!saved) return;
    app.file.handle = saved.handle;
    app.documents.markSaved();
  } catch (error) {
    tell(app, strings.messages.saveFailed, [String(error)]);
  }
}

/** `extension`: of a format that the package writes, without its first dot. */
export async function downloadMesh(app: App, extension: string): Promise<void> {
  const { mesh } = app.run.state.getState();
  const { project } = app.documents;
  if (!mesh) return;
  try {
    const files = await writeMeshFiles(mesh, project, `${fileStem(project.name)}.${extension}`);
    for (const { fileName, content } of files) download([content], fileName, "application/octet-stream");
  } catch (error) {
    tell(app, strings.messages.downloadFailed, [String(error)]);
  }
}

export function downloadReport(app: App): void {
  const { mesh } = app.run.state.getState();
  if (!mesh) return;
  const text = `${JSON.stringify(mesh.report, null, 2)}\n`;
  download([text], `${fileStem(app.documents.project.name)}-report.json`, "application/json");
}

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

/** Selects the first entity that a problem is about and moves the view to its place. */
export function showProblem(app: App, problem: Problem): void {
  if (problem.entities.length > 0) showEntities(app, problem.entities.slice(0, 1));
  if (problem.code === "outside-background-grid") app.view.setLayer("background", true);
  if (problem.place) app.viewer.getState().viewer?.fitPlace(problem.place);
}

/** Marks an element of the mesh on show and moves the view to it. */
export function showElement(app: App, tetrahedron: number): void {
  app.view.setLayer("mesh", true);
  app.view.selectElement(tetrahedron);
  app.shell.setState({ drawer: null });
  app.viewer.getState().viewer?.fitMarked();
}

/** Marks triangles of the boundary that the last run has refused, and moves the view to them. */
export function showTriangles(app: App, triangles: readonly number[]): void {
  app.view.markTriangles(triangles);
  app.shell.setState({ drawer: null });
  app.viewer.getState().viewer?.fitMarked();
}

/** Adds to the project what an offer makes, and selects it; or tells why it cannot be. */
export function takeOffer(app: App, title: string, offer: Offer): void {
  if (!offer.possible) {
    tell(app, title, [offer.reason]);
    return;
  }
  create(app, offer.creation);
}

export function create(app: App, { edit, entities }: Creation): void {
  app.documents.edit(edit);
  app.view.selectAll(entities);
  app.shell.setState({ rightTab: "inspector", leftTab: "model" });
}

/** One sentence on the mesh, for the label of the picture. */
export function describeMesh(project: Project, mesh: MeshResult | null): string {
  if (!mesh || mesh.report.tetrahedra === 0) return strings.viewport.summaryNoMesh(project.name);
  const { tetrahedra, dihedral } = mesh.report;
  return strings.viewport.summary(project.name, formatCount(tetrahedra), `${dihedral.min.toFixed(1)}°`);
}
