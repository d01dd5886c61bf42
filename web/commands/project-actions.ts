import type { Project } from "tetrafront";
import type { App } from "../app/app";
import { emptyProject } from "../document/create";
import { openProjectFile, readProjectFile, saveProjectFile, type OpenResult } from "../session/files";
import { loadModel, type GalleryModel } from "../session/gallery";
import { strings } from "../ui/strings";
import { showMessage } from "./messages";

/** Shows another project in place of the present one. Undoable. */
function showProject(app: App, project: Project, label: string): void {
  app.documents.open(project, label);
  app.run.forgetOthers();
  app.file.handle = null;
  app.view.reset();
  app.view.setCut({ enabled: false });
  app.viewer.getState().viewer?.reset();
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
    showMessage(app, strings.messages.openFailed(model.title), [String(error)]);
  }
}

function takeOpened(app: App, result: OpenResult): void {
  if (result.kind === "opened") openProject(app, result.project);
  else if (result.kind === "failed")
    showMessage(app, strings.messages.openFailed(result.fileName), result.reasons);
}

export async function openFromDialog(app: App): Promise<void> {
  try {
    takeOpened(app, await openProjectFile());
  } catch (error) {
    showMessage(app, strings.messages.noOpenDialog, [String(error)]);
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
    showMessage(app, strings.messages.saveFailed, [String(error)]);
  }
}
